// SPDX-License-Identifier: Apache-2.0
#include "core/os/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "core/text/environment.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

// Returns the absolute path of a program, which is searched in PATH if its name has no slash. Relative folders in PATH
// are those of the calling process, wherever the child runs. Throws Error if there is no such program.
std::string program_file(const std::string& name)
{
    std::error_code error;
    if (name.find('/') != std::string::npos) return fs::absolute(name, error).string();
    std::string path = environment_variable("PATH");
    if (path.empty()) path = "/bin:/usr/bin";
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find(':', begin), path.size());
        const fs::path file = fs::absolute(fs::path(path.substr(begin, end - begin)) / name, error);
        if (fs::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0) return file.string();
        begin = end + 1;
    }
    throw Error(fmt::format("does not start: {}: {}", name, std::strerror(ENOENT)));
}

void confine()
{
    constexpr rlim_t largest_file = 1 << 30;  // bytes
    const rlimit file{.rlim_cur = largest_file, .rlim_max = largest_file};
    const rlimit core{.rlim_cur = 0, .rlim_max = 0};
    setrlimit(RLIMIT_FSIZE, &file);
    setrlimit(RLIMIT_CORE, &core);
}

// Replaces the calling process, a forked child, by the program in `file`. Calls only async-signal-safe functions.
// Returns only if the program does not start.
void become(const ChildSetup& setup, const char* file, char* const* words, char* const* environment, pid_t parent)
{
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(exit_failure);  // the parent has already ended
    if (setup.confined) confine();
    std::signal(SIGPIPE, SIG_DFL);  // this project's programs ignore it, and the child inherits that
    std::signal(SIGTTOU, SIG_IGN);  // a group in the background may write to the terminal
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    const std::array from{setup.input < 0 ? nothing : setup.input, setup.output < 0 ? nothing : setup.output,
                          setup.errors < 0 ? STDERR_FILENO : setup.errors};
    for (int to = 0; to < 3; ++to) {
        if (dup2(from[to], to) < 0) return;
    }
    if (!setup.folder.empty() && chdir(setup.folder.c_str()) != 0) return;
    if (setup.program.empty()) {
        execvpe(file, words, environment);  // also runs scripts without #!, as shells do
    } else {
        execve(file, words, environment);
    }
}

pid_t started(ChildSetup& setup)
{
    std::vector<char*> words;
    for (std::string& word : setup.words) words.push_back(word.data());
    words.push_back(nullptr);
    std::vector<char*> environment;
    for (char** one = environ; *one != nullptr; ++one) {
        const auto is_beginning = [one](const std::string& name) { return std::string_view(*one).starts_with(name); };
        if (std::ranges::none_of(setup.hidden, is_beginning)) environment.push_back(*one);
    }
    environment.push_back(nullptr);
    const std::string file = setup.program.empty() ? program_file(setup.words[0]) : setup.program;
    auto [failed, fails] = make_pipe();  // a successful exec closes `fails`
    const pid_t parent = getpid();
    // Does not use posix_spawn(), because its child at first shares this process's memory, and that memory would count
    // in the child's peak resident set.
    const pid_t child = fork();
    if (child == 0) {
        become(setup, file.c_str(), words.data(), environment.data(), parent);
        const int why = errno;
        static_cast<void>(!write(fails.number(), &why, sizeof why));
        _exit(exit_failure);
    }
    int why = child < 0 ? errno : 0;
    fails = Descriptor();
    while (child > 0 && read(failed.number(), &why, sizeof why) < 0 && errno == EINTR) continue;
    if (why == 0) return child;
    while (child > 0 && waitpid(child, nullptr, 0) < 0 && errno == EINTR) continue;
    throw Error(fmt::format("does not start: {}: {}", setup.words[0], std::strerror(why)));
}

double seconds_of(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::pair<Descriptor, Descriptor> make_pipe()
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(fmt::format("a pipe: {}", std::strerror(errno)));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

MemoryFile::MemoryFile() : descriptor_(memfd_create("mandelmarch", MFD_CLOEXEC))
{
    if (number() < 0) throw Error(fmt::format("a file in memory: {}", std::strerror(errno)));
}

std::string MemoryFile::text(std::size_t most) const
{
    const auto size = static_cast<std::size_t>(std::max<off_t>(0, lseek(number(), 0, SEEK_END)));
    std::string text(std::min(most, size), '\0');
    const ssize_t got = pread(number(), text.data(), text.size(), static_cast<off_t>(size - text.size()));
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
    return text;
}

std::string Ended::text() const
{
    return signal == 0 ? fmt::format("exit code {}", code) : fmt::format("signal {} ({})", signal, strsignal(signal));
}

ChildProcess::ChildProcess(ChildSetup setup) : id_(started(setup)) { group_.emplace(id_); }

ChildProcess::~ChildProcess()
{
    try {
        end(0);
    } catch (const Error&) {
        return;  // nobody asks any more how it ended
    }
}

void ChildProcess::send(int signal) const
{
    if (!ended_) ::kill(group_ ? -id_ : id_, signal);
}

void ChildProcess::take()
{
    Ended ended{.seconds = seconds_since(start_)};
    if (group_) kill();  // the processes that the child has left running
    group_.reset();
    int status = 0;
    rusage used{};
    pid_t waited = 0;
    do {
        waited = wait4(id_, &status, 0, &used);
    } while (waited < 0 && errno == EINTR);
    if (waited < 0) {
        const int why = errno;
        ended_ = Ended{.code = exit_failure};
        throw Error(fmt::format("how a child process ended is not known: {}", std::strerror(why)));
    }
    ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    ended.code = ended.signal == 0 ? WEXITSTATUS(status) : 128 + ended.signal;
    ended.processor = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    ended.memory = static_cast<std::uint64_t>(used.ru_maxrss) << 10;
    ended_ = ended;
}

bool ChildProcess::ends_within(double seconds)
{
    const auto start = Clock::now();
    Descriptor end;
    while (!ended_) {
        siginfo_t found{};
        if (waitid(P_PID, id_, &found, WEXITED | WNOHANG | WNOWAIT) != 0 || found.si_pid != 0) {
            take();
            break;
        }
        const double left = seconds - seconds_since(start);
        if (left <= 0) return false;
        // Uses a system call, because glibc 2.36 declares pidfd_open() for C only. If the call fails, checks every
        // millisecond.
        if (end.number() < 0) end = Descriptor(static_cast<int>(syscall(SYS_pidfd_open, id_, 0)));
        pollfd wanted{.fd = end.number(), .events = POLLIN, .revents = 0};
        poll(&wanted, 1, end.number() < 0 ? 1 : static_cast<int>(std::ceil(std::min(1e3 * left, 1e9))));
    }
    return true;
}

const Ended& ChildProcess::end(double seconds)
{
    if (!ends_within(seconds)) {
        kill();
        ends_within(no_limit);
        ended_->timed_out = true;
    }
    return *ended_;
}

}  // namespace mandelmarch
