// SPDX-License-Identifier: Apache-2.0
#include "bench/contender.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "bench/on_demand.h"
#include "core/base/error.h"
#include "core/base/text.h"

extern char** environ;  // NOLINT: POSIX requires the program to declare it

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

// Returns this process's environment variables with OMP_WAIT_POLICY=passive. Without it, waiting OpenMP threads would
// spin: they would occupy cores that the other program uses, and the spinning would count as processor time.
std::vector<std::string> variables_of_contenders()
{
    std::vector<std::string> variables{"OMP_WAIT_POLICY=passive"};
    for (char** variable = environ; *variable != nullptr; ++variable) {
        if (!std::string_view(*variable).starts_with("OMP_WAIT_POLICY=")) variables.emplace_back(*variable);
    }
    return variables;
}

std::string ending(int status)
{
    if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
    const int code = WEXITSTATUS(status);
    return fmt::format("ended with {}{}", code,
                       code == exit_usage ? ", as a bench without duels does that has no option --on-demand" : "");
}

}  // namespace

DuelProcess::DuelProcess(const std::string& program, const std::vector<std::string>& arguments, DuelClock clock)
    : clock_(clock)
{
    std::array<int, 2> pair{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) {
        throw Error(fmt::format("a socket: {}", std::strerror(errno)));
    }
    socket_.emplace(pair[0]);
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.emplace_back("--on-demand");
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pair[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<std::string> variables = variables_of_contenders();
    std::vector<char*> envp;
    envp.reserve(variables.size() + 1);
    for (std::string& variable : variables) envp.push_back(variable.data());
    envp.push_back(nullptr);
    const int code = posix_spawn(&process_, program.c_str(), &actions, nullptr, argv.data(), envp.data());
    posix_spawn_file_actions_destroy(&actions);
    close(pair[1]);
    if (code != 0) {
        process_ = 0;
        throw Error(fmt::format("does not start: {}", std::strerror(code)));
    }
}

DuelProcess::~DuelProcess()
{
    socket_.reset();  // the process exits when its socket is closed
    for (int i = 0; i < 100 && !ended(); ++i) usleep(20'000);
    if (ended()) return;
    kill(process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

bool DuelProcess::ended()
{
    if (process_ == 0 || status_) return true;
    int status = 0;
    const pid_t found = waitpid(process_, &status, WNOHANG);
    if (found == process_) status_ = status;
    return found == process_ || (found < 0 && errno == ECHILD);
}

std::string DuelProcess::how_it_ended()
{
    for (int i = 0; i < 100 && !ended(); ++i) usleep(20'000);
    return status_ ? ending(*status_) : "closed its socket";
}

Json DuelProcess::receive()
{
    std::string line;
    if (!socket_->receive(line, [this] { return ended(); })) {
        throw Error(how_it_ended());
    }
    check_json_depth(line, "its answer");
    Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded() || !json.is_object()) throw Error("does not answer as bench does");
    return json;
}

void DuelProcess::wait()
{
    const Json hello = receive();
    try {
        if (hello.at("version") != on_demand_version) throw Error("is a bench whose duels are of another version");
        environment_ = hello.at("environment");
        for (const Json& row : hello.at("rows")) {
            const Json& failure = row.at("failure");
            rows_[row.at("name")] = {row.at("fingerprint"), failure.is_null() ? "" : failure.get<std::string>(),
                                     row.at("in_process")};
        }
    } catch (const nlohmann::json::exception&) {
        throw Error("does not answer as bench does");
    }
}

DuelProcess::Drawn DuelProcess::draw(const std::string& row)
{
    try {
        socket_->send(row);
    } catch (const Error&) {
        throw Error(how_it_ended());
    }
    const Json answer = receive();
    if (const auto seconds = answer.find(clock_ == DuelClock::processor ? "processor" : "kernel");
        seconds != answer.end() && seconds->is_number()) {
        return {.seconds = seconds->get<double>(), .failure = {}};
    }
    const auto failure = answer.find("failure");
    if (failure == answer.end() || !failure->is_string()) throw Error("does not answer as bench does");
    return {.seconds = std::nullopt, .failure = failure->get<std::string>()};
}

}  // namespace mandelmarch::bench
