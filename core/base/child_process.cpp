// SPDX-License-Identifier: Apache-2.0
#include "core/base/child_process.h"

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

#include "core/base/error.h"

namespace mandelmarch {
namespace {

void confine(pid_t parent)
{
    constexpr rlim_t largest_file = 1 << 30;  // bytes
    const rlimit file{.rlim_cur = largest_file, .rlim_max = largest_file};
    const rlimit core{.rlim_cur = 0, .rlim_max = 0};
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(exit_failure);  // the parent has already ended
    setrlimit(RLIMIT_FSIZE, &file);
    setrlimit(RLIMIT_CORE, &core);
}

// Replaces the calling process, a forked child, by the program. Calls only async-signal-safe functions. Returns only if
// the program does not start.
void become(const ChildSetup& setup, char* const* words)
{
    std::signal(SIGPIPE, SIG_DFL);  // this project's programs ignore it, and the child inherits that
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    const std::array from{setup.input < 0 ? nothing : setup.input, setup.output < 0 ? nothing : setup.output,
                          setup.errors < 0 ? STDERR_FILENO : setup.errors};
    for (int to = 0; to < 3; ++to) {
        if (dup2(from[to], to) < 0) return;
    }
    if (!setup.folder.empty() && chdir(setup.folder.c_str()) != 0) return;
    if (setup.program.empty()) {
        execvp(words[0], words);
    } else {
        execv(setup.program.c_str(), words);
    }
}

pid_t started(ChildSetup& setup)
{
    std::vector<char*> words;
    for (std::string& word : setup.words) words.push_back(word.data());
    words.push_back(nullptr);
    auto [failed, fails] = make_pipe();  // a successful exec closes `fails`
    const pid_t parent = getpid();
    // Does not use posix_spawn(), because its child at first shares this process's memory, and that memory would count
    // in the child's peak resident set.
    const pid_t child = fork();
    if (child == 0) {
        if (setup.confined) confine(parent);
        become(setup, words.data());
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

ChildProcess::ChildProcess(ChildSetup setup) : confined_(setup.confined), id_(started(setup)) {}

void ChildProcess::kill() const
{
    if (!ended_) ::kill(confined_ ? -id_ : id_, SIGKILL);
}

void ChildProcess::take()
{
    Ended ended{.seconds = seconds_since(start_)};
    if (confined_) kill();  // the processes that the child has left running
    int status = 0;
    rusage used{};
    while (wait4(id_, &status, 0, &used) < 0 && errno == EINTR) continue;
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
