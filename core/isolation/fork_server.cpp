// SPDX-License-Identifier: Apache-2.0
#include "core/isolation/fork_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <stdio_ext.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <set>

#include "core/isolation/message.h"
#include "core/os/child_process.h"
#include "core/text/console.h"
#include "core/text/environment.h"
#include "core/text/error.h"

namespace mandelmarch::isolation {
namespace {

using Task = std::function<void(Channel)>;

constexpr double patience = 1;  // seconds within which a process must exit after its channel was closed

// Returns the program's ends of the channels to its fork servers. The processes of a later fork server close them.
std::set<int>& channels()
{
    static std::set<int> all;
    return all;
}

[[noreturn]] void fail(const char* what)
{
    throw Error(fmt::format("{} for a device: {}", what, std::strerror(errno)));
}

// Forks the process. The child is killed when its parent ends, and discards the parent's unwritten output.
pid_t fork_tied()
{
    const pid_t parent = getpid();
    const pid_t id = fork();
    if (id != 0) return id;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(exit_failure);
    __fpurge(stdout);
    __fpurge(stderr);
    return 0;
}

// Runs `work` in a new process. Output of drivers goes to the pipe `output`, so that it does not mix with the program's
// results on stdout.
[[noreturn]] void run(const Task& work, Descriptor socket, Descriptor output)
{
    const Descriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
    dup2(nothing.number(), STDIN_FILENO);
    dup2(output.number(), STDOUT_FILENO);
    dup2(output.number(), STDERR_FILENO);
    try {
        work(Channel(std::move(socket)));
    } catch (const std::exception& error) {
        say("{}\n", error.what());
        _exit(exit_failure);
    }
    _exit(exit_success);
}

// Serves the program's requests. A request for a new process consists of two messages: one has the process's socket,
// the other the pipe for its output. Any other message is a request to end the process that it names.
[[noreturn]] void tend(const Task& work, Channel channel)
{
    std::signal(SIGCHLD, SIG_DFL);  // otherwise the system would not report how device processes end
    for (const int other : channels()) close(other);
    while (auto request = channel.receive()) {
        Serializer response;
        if (request->descriptor.number() >= 0) {
            auto output = channel.receive();
            if (!output) break;
            const pid_t child = fork_tied();
            if (child == 0) {
                channel = Channel(Descriptor());
                run(work, std::move(request->descriptor), std::move(output->descriptor));
            }
            response(child, errno);
        } else {
            Deserializer reader(request->bytes);
            const auto child = reader.take<pid_t>();
            response(ChildProcess(child).end(reader.take<bool>() ? 0 : patience).text());
        }
        if (!channel.send(response.bytes())) break;
    }
    _exit(exit_success);
}

}  // namespace

ForkServer::ForkServer(const Task& work) : channel_(Descriptor())
{
    std::pair<Channel, Channel> ends = Channel::pair();
    id_ = fork_tied();
    if (id_ < 0) fail("no process");
    if (id_ == 0) {
        ends.first = Channel(Descriptor());
        tend(work, std::move(ends.second));
    }
    channel_ = std::move(ends.first);
    channels().insert(channel_.number());
}

ForkServer::~ForkServer()
{
    channels().erase(channel_.number());
    // The system then also kills the device processes, whose parent is the fork server (PR_SET_PDEATHSIG).
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
}

std::optional<Packet> ForkServer::request(std::initializer_list<std::pair<std::string, int>> messages) const
{
    const std::scoped_lock lock(mutex_);
    for (const auto& [bytes, descriptor] : messages) {
        if (!channel_.send(bytes, descriptor)) return std::nullopt;
    }
    constexpr double most = 20;
    const double seconds = std::min(device_timeout(), most) + 2 * patience;
    if (!channel_.waiting(static_cast<int>(1e3 * seconds))) kill(id_, SIGKILL);  // for example, it was stopped
    return channel_.receive();
}

Child ForkServer::start() const
{
    auto [ours, theirs] = Channel::pair();
    auto [output, input] = make_pipe();
    fcntl(output.number(), F_SETFL, O_NONBLOCK);
    const auto response = request({{"socket", theirs.number()}, {"pipe", input.number()}});
    if (!response) throw Error("the process that starts processes for devices has ended");
    Deserializer reader(response->bytes);
    const auto id = reader.take<pid_t>();
    errno = reader.take<int>();
    if (id < 0) fail("no process");
    return {id, std::move(ours), std::move(output)};
}

std::string ForkServer::end(pid_t child, bool now) const
{
    const auto response = request({{Serializer(child, now).bytes(), -1}});
    if (!response) return "all of the program's other processes have ended";
    return Deserializer(response->bytes).take<std::string>();
}

}  // namespace mandelmarch::isolation
