// SPDX-License-Identifier: Apache-2.0
#include "bench/contest/contender.h"

#include <fmt/format.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "bench/contest/on_demand.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double last_wait = 2;  // seconds for a program that has closed its socket

}  // namespace

DuelProcess::DuelProcess(const std::string& program, const std::vector<std::string>& arguments, DuelClock clock)
    : clock_(clock)
{
    std::array<int, 2> pair{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) {
        throw Error(fmt::format("a socket: {}", std::strerror(errno)));
    }
    socket_.emplace(Descriptor(pair[0]));
    const Descriptor theirs(pair[1]);
    // Waiting threads sleep. OpenMP's would otherwise spin on the cores that the other program uses, and count as
    // processor time.
    setenv("OMP_WAIT_POLICY", "passive", 1);
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.emplace_back("--on-demand");
    process_.emplace(ChildSetup{.words = std::move(words), .program = program, .input = theirs.number()});
}

DuelProcess::~DuelProcess()
{
    socket_.reset();  // the process then exits, unless it hangs
    process_->end(last_wait);
}

std::string DuelProcess::how_it_ended()
{
    if (!process_->ends_within(last_wait)) return "closed its socket";
    const Ended& ended = process_->end();
    if (ended.signal != 0) return fmt::format("was ended by signal {}", ended.signal);
    return fmt::format(
        "ended with {}{}", ended.code,
        ended.code == exit_usage ? ", as a bench without duels does that has no option --on-demand" : "");
}

Json DuelProcess::receive()
{
    std::string line;
    if (!socket_->receive(line, [this] { return process_->ends_within(0); })) {
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
