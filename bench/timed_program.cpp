// SPDX-License-Identifier: Apache-2.0
#include "bench/timed_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "core/base/error.h"
#include "core/base/stopwatch.h"

namespace mandelmarch::bench {
namespace {

constexpr rlim_t largest_file = 1 << 30;         // bytes
constexpr std::streamoff most_complaint = 4096;  // bytes read from the end of standard error

// Runs in the child process and replaces it by the program. Returns only if the program cannot be started. Between
// fork() and exec only async-signal-safe functions may be called.
void become(char* const* argv, const char* folder, const char* complaints, pid_t parent)
{
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(exit_failure);  // the parent has ended already
    const rlimit file{.rlim_cur = largest_file, .rlim_max = largest_file};
    const rlimit core{.rlim_cur = 0, .rlim_max = 0};
    setrlimit(RLIMIT_FSIZE, &file);
    setrlimit(RLIMIT_CORE, &core);
    const int nothing = open("/dev/null", O_RDWR);
    const int errors = open(complaints, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (nothing < 0 || errors < 0 || chdir(folder) != 0) return;
    if (dup2(nothing, STDIN_FILENO) < 0 || dup2(nothing, STDOUT_FILENO) < 0 || dup2(errors, STDERR_FILENO) < 0) return;
    execv(argv[0], argv);
}

std::string last_line(const std::string& path)
{
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return {};
    const std::streamoff size = file.tellg();
    file.seekg(std::max<std::streamoff>(0, size - most_complaint));
    std::string last;
    for (std::string line; std::getline(file, line);) {
        if (!line.empty()) last = line;
    }
    return last;
}

double seconds_of(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Returns false if the process still runs after `limit` seconds.
bool ends_within(pid_t process, double limit)
{
    // glibc 2.36 declares pidfd_open() for C only.
    const auto descriptor = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
    if (descriptor < 0) throw Error(fmt::format("cannot be waited for: {}", std::strerror(errno)));
    const auto start = Clock::now();
    pollfd wanted{.fd = descriptor, .events = POLLIN, .revents = 0};
    int found = 0;
    do {
        const double left = 1e3 * (limit - seconds_since(start));
        found = poll(&wanted, 1, static_cast<int>(std::clamp(left, 0.0, 1e9)));
    } while (found < 0 && errno == EINTR);
    close(descriptor);
    return found > 0;
}

}  // namespace

Ended run_timed(const std::vector<std::string>& words, const std::string& folder, const std::string& complaints,
                double limit)
{
    std::vector<std::string> copies = words;
    std::vector<char*> argv;
    argv.reserve(copies.size() + 1);
    for (std::string& word : copies) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::array<int, 2> pipe{};
    if (pipe2(pipe.data(), O_CLOEXEC) != 0) throw Error(fmt::format("a pipe: {}", std::strerror(errno)));

    Ended ended;
    const auto start = Clock::now();
    const pid_t parent = getpid();
    // fork() is used as with posix_spawn() this process's resident memory would count as the program's.
    const pid_t child = fork();
    if (child == 0) {
        become(argv.data(), folder.c_str(), complaints.c_str(), parent);
        const int code = errno;
        static_cast<void>(!write(pipe[1], &code, sizeof(code)));
        _exit(exit_failure);
    }
    const int forked = errno;
    close(pipe[1]);
    int why = 0;
    ssize_t got = 0;
    do {
        got = child > 0 ? read(pipe[0], &why, sizeof(why)) : 0;
    } while (got < 0 && errno == EINTR);
    close(pipe[0]);
    if (child < 0) throw Error(fmt::format("does not start: {}", std::strerror(forked)));

    ended.timed_out = got == 0 && !ends_within(child, limit - seconds_since(start));
    ended.seconds = seconds_since(start);
    kill(-child, SIGKILL);  // including the processes it started
    int status = 0;
    rusage used{};
    while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) continue;
    if (got != 0) throw Error(fmt::format("does not start: {}", std::strerror(why)));
    ended.processor = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    ended.memory = static_cast<std::uint64_t>(used.ru_maxrss) << 10;
    if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
    ended.complaint = last_line(complaints);
    return ended;
}

}  // namespace mandelmarch::bench
