// SPDX-License-Identifier: Apache-2.0
// An output file appears complete or not at all, even if it is written through a link or descriptor, or if a signal
// ends the program. A read error is not the end of a file. A command must not use one file for two purposes, even under
// different names.
#include "core/os/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>
#include <vector>

#include "core/os/files.h"
#include "core/os/input_file.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "tests/refusal.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Forks a process that calls `child` and then sleeps. Sends the signal to this process and returns its status from
// waitpid().
int end_of(const std::function<void()>& child, int signal)
{
    std::array<int, 2> ready{};
    EXPECT_EQ(pipe(ready.data()), 0);
    const pid_t pid = fork();
    if (pid == 0) {
        // A driver that an earlier test has opened may have set handlers.
        for (const int one : {SIGINT, SIGTERM, SIGHUP}) std::signal(one, SIG_DFL);
        child();
        static_cast<void>(::write(ready[1], "x", 1));
        sleep(20);
        _exit(0);
    }
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1);
    kill(pid, signal);
    int status = 0;
    EXPECT_EQ(waitpid(pid, &status, 0), pid);
    for (const int end : ready) close(end);
    return status;
}

class OutputFiles : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder / name).string(); }

    const TemporaryFolder made;
    const fs::path folder = made.path();
};

TEST_F(OutputFiles, InSharedMemoryAreReplaced)
{
    if (access("/dev/shm", W_OK) != 0) GTEST_SKIP() << "no /dev/shm";
    const std::string file = "/dev/shm/mandelmarch-test-" + std::to_string(getpid());
    std::ofstream(file) << "an older and longer text";
    EXPECT_FALSE(OutputFile::is_stream(file));
    write_file(file, "new");
    EXPECT_EQ(text_of(file), "new");
    fs::remove(file);
}

TEST_F(OutputFiles, DescriptorIsWrittenAtItsPosition)
{
    std::ofstream(path("log")) << "0123456789";
    const int descriptor = open(path("log").c_str(), O_WRONLY);
    ASSERT_EQ(::write(descriptor, "ab", 2), 2);
    fs::create_symlink("/dev/fd/" + std::to_string(descriptor), path("link"));
    for (const std::string& name : {"/dev/fd/" + std::to_string(descriptor), path("link")}) {
        EXPECT_TRUE(OutputFile::is_stream(name));
        EXPECT_NO_THROW(OutputFile::check(name));
        write_file(name, "cd");
    }
    close(descriptor);
    EXPECT_EQ(text_of(path("log")), "abcdcd6789");
    EXPECT_TRUE(fs::is_symlink(path("link")));
}

TEST_F(OutputFiles, ReadOnlyDescriptorIsRefused)
{
    std::ofstream(path("log")) << "text";
    const int descriptor = open(path("log").c_str(), O_RDONLY);
    EXPECT_THROW(OutputFile::check("/dev/fd/" + std::to_string(descriptor)), InputError);
    close(descriptor);
    EXPECT_THROW(OutputFile::check("/dev/fd/" + std::to_string(descriptor)), InputError);
}

TEST_F(OutputFiles, DanglingLinkStaysAndItsTargetIsCreated)
{
    fs::create_directory(path("inner"));
    fs::create_symlink("inner/second", path("first"));
    fs::create_symlink("../target", path("inner/second"));
    write_file(path("first"), "text");
    EXPECT_TRUE(fs::is_symlink(path("first")));
    EXPECT_EQ(text_of(path("target")), "text");
}

TEST_F(OutputFiles, LinksThatLeadNowhereAreRefused)
{
    fs::create_symlink("circle", path("circle"));
    EXPECT_THROW(OutputFile::check(path("circle")), InputError);
    EXPECT_THROW(OutputFile(path("circle")), Error);
    fs::create_symlink("missing/target", path("link"));
    EXPECT_THROW(OutputFile::check(path("link")), InputError);
}

TEST_F(OutputFiles, IgnoredSignalDoesNotEndTheProcess)
{
    const auto half = [this] {
        std::signal(SIGHUP, SIG_IGN);
        OutputFile file(path("a"));
        raise(SIGHUP);
        file.write("text", 4);
        file.commit();
    };
    end_of(half, SIGTERM);
    EXPECT_EQ(text_of(path("a")), "text");
}

TEST_F(OutputFiles, AForkedProcessLeavesFilesOfItsParentAlone)
{
    OutputFile file(path("a"));
    file.write("text", 4);
    end_of([this] { write_file(path("b"), "its own"); }, SIGTERM);
    file.commit();
    EXPECT_EQ(text_of(path("a")), "text");
}

using Refusals = std::vector<std::pair<long, unsigned>>;

// Makes these system calls fail with these errors, in all threads of this process.
void refuse(const Refusals& calls)
{
    std::vector<sock_filter> filter{BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr))};
    for (const auto& [call, error] : calls) {
        filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, 1));
        filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error));
    }
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    const sock_fprog all{static_cast<unsigned short>(filter.size()), filter.data()};
    ASSERT_EQ(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), 0);
    ASSERT_EQ(syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &all), 0);
}

// For EXPECT_EXIT: runs `body` and ends this process; prints the message of the exception, if `body` throws one.
[[noreturn]] void leave(const std::function<void()>& body)
{
    try {
        body();
    } catch (const std::exception& error) {
        say(error.what());
    }
    _exit(0);
}

[[noreturn]] void write_despite(const Refusals& calls, const std::string& path)
{
    leave([&] {
        refuse(calls);
        write_file(path, "text");
    });
}

const testing::ExitedWithCode ended(0);

#ifdef SYS_rename
const Refusals mounted{{SYS_rename, EBUSY}};
#else
const Refusals mounted{{SYS_renameat, EBUSY}};
#endif

TEST_F(OutputFiles, ARefusedChmodOrFlushLosesNothing)
{
    EXPECT_EXIT(write_despite({{SYS_fchmod, EPERM}, {SYS_fsync, EINVAL}}, path("a")), ended, "a: its rights stay");
    EXPECT_EQ(text_of(path("a")), "text");
    EXPECT_EXIT(write_despite({{SYS_fsync, EIO}}, path("b")), ended, "b: cannot write it: Input/output error");
    EXPECT_EQ(files_in(folder).size(), 1U);
}

TEST_F(OutputFiles, AFileThatCannotBeReplacedIsWrittenInPlace)
{
    std::ofstream(path("a")) << "an older and longer text";
    EXPECT_EXIT(write_despite(mounted, path("a")), ended, "^$");
    EXPECT_EQ(text_of(path("a")), "text");
    EXPECT_EQ(files_in(folder).size(), 1U);
    fs::remove(path("a"));
    EXPECT_EXIT(write_despite(mounted, path("a")), ended, "a: cannot write it: .*; what was to be written is in /");
    EXPECT_EQ(text_of(files_in(folder).front()), "text");
}

TEST_F(OutputFiles, AnotherUsersFileInAStickyFolderIsRefused)
{
    if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
    std::ofstream(path("a")) << "text";
    ASSERT_EQ(chmod(folder.c_str(), 01777), 0);
    const auto check = [this] {
        ASSERT_EQ(setuid(65534), 0);
        OutputFile::check(path("new"));
        OutputFile::check(path("a"));
    };
    EXPECT_EXIT(leave(check), ended, "a: it is another user's");
    chmod(path("a").c_str(), 0666);
    EXPECT_EXIT(leave(check), ended, "^$");
}

TEST_F(OutputFiles, AReplacedFileDoesNotRunAsItsOwner)
{
    std::ofstream(path("a")) << "text";
    ASSERT_EQ(chmod(path("a").c_str(), 06750), 0);
    write_file(path("a"), "text");
    EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms{0750});
}

TEST_F(OutputFiles, NamesOfTheProgramAreReplacedAndNotFollowed)
{
    std::ofstream(path("target")) << "text";
    fs::create_symlink("target", path("a"));
    ASSERT_EQ(mkfifo(path("b").c_str(), 0600), 0);
    for (const char* name : {"a", "b"}) {
        EXPECT_NO_THROW(OutputFile::check(path(name), NamedBy::program));
        write_file(path(name), "new", NamedBy::program);
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path(name))));
    }
    EXPECT_EQ(text_of(path("target")), "text");
}

TEST_F(OutputFiles, ASignalRemovesATemporaryFolder)
{
    setenv("TMPDIR", folder.c_str(), 1);
    const auto fill = [] {
        auto* made = new TemporaryFolder;
        fs::create_directories(made->path() / "a/b");
        fs::create_directory_symlink("/", made->path() / "link");
        std::ofstream(made->path() / "a/b/file") << "text";
        fs::permissions(made->path() / "a", fs::perms::none);
    };
    end_of(fill, SIGTERM);
    unsetenv("TMPDIR");
    EXPECT_TRUE(fs::is_empty(folder));
}

class InputFiles : public OutputFiles {
protected:
    std::string refusal(const std::string& name, std::size_t most = largest_text) const
    {
        return refusal_of([&] { text_of_file(name, "story", most); });
    }
};

TEST_F(InputFiles, ReadErrorIsNotTheEndOfTheFile)
{
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    const auto read_half = [this] {
        std::thread reader([this] { say(refusal(path("pipe"))); });
        const int end = open(path("pipe").c_str(), O_WRONLY);
        int unread = static_cast<int>(::write(end, "half", 4));
        while (unread > 0) ioctl(end, FIONREAD, &unread);
        refuse({{SYS_read, EIO}});
        EXPECT_EQ(::write(end, "a", 1), 1);  // ends a call of read() in progress; the next one fails
        close(end);
        reader.join();
    };
    EXPECT_EXIT(leave(read_half), ended, "pipe: Input/output error, expected a story");
}

TEST_F(InputFiles, BinaryAndLargeFilesAreRefused)
{
    const auto file = [&](std::string_view text) {
        write_file(path("a"), text);
        return path("a");
    };
    EXPECT_EQ(text_of_file(file("\xEF\xBB\xBFtext"), "story"), "text");
    EXPECT_EQ(text_of_file(file(""), "story"), "");
    EXPECT_EQ(refusal(file("12345"), 5), "");
    EXPECT_EQ(refusal(file("123456"), 5), path("a") + ": it has more than 5 bytes, expected a story");
    EXPECT_NE(refusal(file("\xFF\xFEt")).find("UTF-16"), std::string::npos);
    EXPECT_NE(refusal("/dev/zero").find("NUL"), std::string::npos);
}

TEST_F(InputFiles, TheProgramReadsOnlyRegularFilesOfItsOwn)
{
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    for (const std::string& name : {path("pipe"), folder.string(), path("missing"), std::string("/dev/zero")}) {
        EXPECT_FALSE(own_file(name)) << name;
    }
    write_file(path("a"), "text");
    EXPECT_EQ(own_file(path("a")), "text");
}

using FileNames = OutputFiles;

TEST_F(FileNames, OneFileHasManyNames)
{
    fs::create_directories(folder / "inner");
    std::ofstream(path("there")) << "text";
    std::ofstream(path("other")) << "text";
    fs::create_symlink("there", path("link"));
    fs::create_hard_link(path("there"), path("hard"));
    fs::create_symlink("missing", path("dangling"));
    fs::create_directory_symlink("inner", path("door"));
    using Names = std::vector<std::pair<const char*, const char*>>;
    for (const auto& [a, b] : Names{{"there", "inner/../there"},
                                    {"there", "link"},
                                    {"there", "hard"},
                                    {"missing", "./inner/../missing"},
                                    {"missing", "dangling"},
                                    {"inner/new", "door/new"}}) {
        EXPECT_TRUE(same_file(path(a), path(b))) << a << " " << b;
    }
    for (const auto& [a, b] : Names{{"there", "other"}, {"there", "missing"}, {"inner/new", "new"}, {"new", "newer"}}) {
        EXPECT_FALSE(same_file(path(a), path(b))) << a << " " << b;
    }
}

TEST_F(FileNames, OneFileForTwoPurposesIsRefused)
{
    std::ofstream(path("there")) << "text";
    EXPECT_THROW(refuse_shared_files({{"--output", path("new")}, {"--stats", path("new")}}), InputError);
    EXPECT_THROW(refuse_shared_files({{"--output", path("there")}}, {{"PARAMS", path("./there")}}), InputError);
    EXPECT_NO_THROW(refuse_shared_files({{"--map", path("new")}}, {{"A", path("there")}, {"B", path("there")}}));
    EXPECT_NO_THROW(refuse_shared_files({{"--output", path("new")}, {"--stats", ""}, {"--json", ""}}));
    EXPECT_NO_THROW(refuse_shared_files({{"--output", "/dev/null"}, {"--stats", "/dev/null"}}));
}

}  // namespace
}  // namespace mandelmarch
