// SPDX-License-Identifier: Apache-2.0
// An output file appears complete or not at all, even if it is written through a link or descriptor, or if a signal
// ends the program. A command must not use one file for two purposes, even under different names.
#include "core/base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>

#include "core/base/error.h"
#include "core/base/files.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

void write(const std::string& path, const std::string& text)
{
    OutputFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

std::string text_of(const std::string& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t entries(const fs::path& folder)
{
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
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

TEST_F(OutputFiles, SharedMemoryIsAFolderAsOthers)
{
    if (access("/dev/shm", W_OK) != 0) GTEST_SKIP() << "no /dev/shm";
    const std::string file = "/dev/shm/mandelmarch-test-" + std::to_string(getpid());
    std::ofstream(file) << "an older and longer text";
    EXPECT_FALSE(OutputFile::is_stream(file));
    write(file, "new");
    EXPECT_EQ(text_of(file), "new");
    fs::remove(file);
    EXPECT_NO_THROW(OutputFile::check(file));
    write(file, "new");
    EXPECT_EQ(text_of(file), "new");
    fs::remove(file);
}

TEST_F(OutputFiles, ADescriptorIsWrittenIntoWhereItStands)
{
    std::ofstream(path("log")) << "0123456789";
    const int descriptor = open(path("log").c_str(), O_WRONLY);
    ASSERT_EQ(::write(descriptor, "ab", 2), 2);
    fs::create_symlink("/dev/fd/" + std::to_string(descriptor), path("link"));
    for (const std::string& name : {"/dev/fd/" + std::to_string(descriptor), path("link")}) {
        EXPECT_TRUE(OutputFile::is_stream(name));
        EXPECT_NO_THROW(OutputFile::check(name));
        write(name, "cd");
    }
    close(descriptor);
    EXPECT_EQ(text_of(path("log")), "abcdcd6789");
    EXPECT_TRUE(fs::is_symlink(path("link")));
}

TEST_F(OutputFiles, ADescriptorThatCannotBeWrittenIsSeenBeforehand)
{
    std::ofstream(path("log")) << "text";
    const int descriptor = open(path("log").c_str(), O_RDONLY);
    EXPECT_THROW(OutputFile::check("/dev/fd/" + std::to_string(descriptor)), InputError);
    close(descriptor);
    EXPECT_THROW(OutputFile::check("/dev/fd/" + std::to_string(descriptor)), InputError);
}

TEST_F(OutputFiles, ADanglingLinkStaysAndItsTargetIsMade)
{
    fs::create_directory(path("inner"));
    fs::create_symlink("inner/second", path("first"));
    fs::create_symlink("../target", path("inner/second"));
    EXPECT_NO_THROW(OutputFile::check(path("first")));
    write(path("first"), "text");
    EXPECT_TRUE(fs::is_symlink(path("first")));
    EXPECT_TRUE(fs::is_symlink(path("inner/second")));
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

TEST_F(OutputFiles, SignalsThatEndTheProcessLeaveNothing)
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const auto half = [this] {
            auto* file = new OutputFile(path("a"));
            file->write("text", 4);
            EXPECT_EQ(entries(folder), 1U);
        };
        const int status = end_of(half, signal);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
        EXPECT_EQ(entries(folder), 0U) << "signal " << signal;
    }
}

// Negative control: a signal that cannot be handled leaves a partial file.
TEST_F(OutputFiles, AKilledProcessLeavesItsHalfFile)
{
    const auto half = [this] { new OutputFile(path("a")); };
    EXPECT_TRUE(WIFSIGNALED(end_of(half, SIGKILL)));
    EXPECT_EQ(entries(folder), 1U);
}

TEST_F(OutputFiles, WhatIsWholeStaysAfterASignal)
{
    const int status = end_of([this] { write(path("a"), "text"); }, SIGTERM);
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(text_of(path("a")), "text");
}

TEST_F(OutputFiles, AnIgnoredSignalIsIgnored)
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
    end_of([this] { write(path("b"), "its own"); }, SIGTERM);
    file.commit();
    EXPECT_EQ(text_of(path("a")), "text");
}

class FileNames : public OutputFiles {
protected:
    FileNames()
    {
        fs::create_directories(folder / "inner");
        std::ofstream(folder / "there") << "text";
        std::ofstream(folder / "other") << "text";
    }
};

TEST_F(FileNames, OneFileHasManyNames)
{
    fs::create_symlink("there", path("link"));
    fs::create_hard_link(path("there"), path("hard"));
    for (const char* name : {"there", "inner/../there", "link", "hard"}) {
        EXPECT_TRUE(same_file(path("there"), path(name))) << name;
    }
    EXPECT_FALSE(same_file(path("there"), path("other")));
    EXPECT_FALSE(same_file(path("there"), path("missing")));
}

TEST_F(FileNames, SoHasAFileThatIsNotThereYet)
{
    fs::create_symlink("missing", path("dangling"));
    fs::create_directory_symlink("inner", path("door"));
    EXPECT_TRUE(same_file(path("missing"), path("./inner/../missing")));
    EXPECT_TRUE(same_file(path("missing"), path("dangling")));
    EXPECT_TRUE(same_file(path("inner/new"), path("door/new")));
    EXPECT_FALSE(same_file(path("inner/new"), path("new")));
    EXPECT_FALSE(same_file(path("new"), path("newer")));
}

TEST_F(FileNames, LinksInACircleAreRefused)
{
    fs::create_symlink("b", path("a"));
    fs::create_symlink("a", path("b"));
    EXPECT_THROW(end_of_links(path("a")), InputError);
}

TEST_F(FileNames, NothingWrittenIsAnotherFile)
{
    EXPECT_THROW(refuse_shared_files({{"--output", path("new")}, {"--stats", path("new")}}), InputError);
    EXPECT_THROW(refuse_shared_files({{"--output", path("there")}}, {{"PARAMS", path("./there")}}), InputError);
    EXPECT_NO_THROW(refuse_shared_files({{"--map", path("new")}}, {{"A", path("there")}, {"B", path("there")}}));
    EXPECT_NO_THROW(refuse_shared_files({{"--output", path("new")}, {"--stats", ""}, {"--json", ""}}));
    EXPECT_NO_THROW(refuse_shared_files({{"--output", "/dev/null"}, {"--stats", "/dev/null"}}));
}

}  // namespace
}  // namespace mandelmarch
