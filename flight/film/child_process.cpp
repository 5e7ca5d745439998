// SPDX-License-Identifier: Apache-2.0
#include "flight/film/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <thread>

#include "core/base/error.h"
#include "core/base/stopwatch.h"

namespace mandelmarch {
namespace {

void close_if_open(int& descriptor)
{
    if (descriptor >= 0) close(descriptor);
    descriptor = -1;
}

std::string contents(int descriptor)
{
    std::string text;
    char part[4096];
    lseek(descriptor, 0, SEEK_SET);
    for (ssize_t n = 0; (n = read(descriptor, part, sizeof part)) > 0;) text.append(part, static_cast<std::size_t>(n));
    return text;
}

constexpr const char* no_space = "No space left on device";

// Returns the line of ffmpeg's error output that names the cause. This is the message of a full disk, if there is one,
// else the first line, because later lines are more general.
std::string cause_of(const std::string& errors)
{
    std::string first;
    for (std::size_t at = 0; at < errors.size();) {
        const auto end = std::min(errors.find('\n', at), errors.size());
        const std::string line = errors.substr(at, end - at);
        if (line.find(no_space) != std::string::npos) return no_space;
        if (first.empty()) first = line;
        at = end + 1;
    }
    return first;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& folder,
                           std::optional<double> limit)
    : limit_(limit)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error(fmt::format("a pipe for {}: {}", command[0], std::strerror(errno)));
    input_ = ends[1];
    output_ = memfd_create("output", MFD_CLOEXEC);
    errors_ = memfd_create("errors", MFD_CLOEXEC);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output_, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors_, STDERR_FILENO);
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    // The child must not inherit that this program ignores SIGPIPE.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t usual;
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int failed = posix_spawnp(&child_, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    if (failed == 0) {
        if (limit_) fcntl(input_, F_SETFL, O_NONBLOCK);
        return;
    }
    child_ = -1;
    close_if_open(input_);
    close_if_open(output_);
    close_if_open(errors_);
    throw Error(fmt::format("{} cannot be started: {}", command[0], std::strerror(failed)));
}

ChildProcess::~ChildProcess()
{
    if (child_ > 0) {
        kill();
        waitpid(child_, nullptr, 0);
    }
    close_if_open(input_);
    close_if_open(output_);
    close_if_open(errors_);
}

void ChildProcess::kill() { ::kill(child_, SIGKILL); }

// Waits until the pipe accepts more data. If the child does not read within the limit, kills it and returns false.
bool ChildProcess::ready()
{
    pollfd pipe{.fd = input_, .events = POLLOUT, .revents = 0};
    int told = 0;
    while ((told = poll(&pipe, 1, static_cast<int>(std::ceil(*limit_ * 1000)))) < 0 && errno == EINTR) {
    }
    if (told > 0) return true;
    hung_ = true;
    kill();
    return false;
}

bool ChildProcess::write(const void* data, std::size_t size)
{
    const char* next = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::write(input_, next, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0 && errno == EAGAIN && ready()) continue;
        if (written <= 0) return false;
        next += written;
        size -= static_cast<std::size_t>(written);
    }
    return true;
}

// Waits for the child to end and returns its status. Kills the child when the limit is over.
int ChildProcess::wait()
{
    const auto start = Clock::now();
    int status = 0;
    for (;;) {
        const pid_t ended = waitpid(child_, &status, limit_ ? WNOHANG : 0);
        if (ended > 0 || (ended < 0 && errno != EINTR)) return status;
        if (!limit_) continue;
        if (!hung_ && seconds_since(start) > *limit_) {
            hung_ = true;
            kill();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

ChildProcess::Result ChildProcess::finish()
{
    close_if_open(input_);
    const int status = wait();
    child_ = -1;
    Result result;
    result.output = contents(output_);
    result.cause = cause_of(contents(errors_));
    // ffmpeg may return exit code 0 although it could not write the end of its file.
    result.ok = WIFEXITED(status) && WEXITSTATUS(status) == 0 && result.cause != no_space && !hung_;
    if (result.ok) {
        result.cause.clear();
        return result;
    }
    if (hung_) {
        result.cause = fmt::format("no answer in {:.6g} s", *limit_);
    } else if (WIFSIGNALED(status)) {
        result.cause = fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
    } else if (result.cause.empty()) {
        result.cause = fmt::format("exit code {}", WEXITSTATUS(status));
    }
    return result;
}

}  // namespace mandelmarch
