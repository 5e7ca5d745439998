// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>

#include "bench/contest/duel.h"
#include "bench/contest/on_demand.h"
#include "bench/machine/steadiness.h"
#include "core/base/child_process.h"
#include "core/base/console.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double last_wait = 2;  // seconds to wait for a program to end after its socket is closed

// One of the two bench processes.
class DuelProcess {
public:
    // State of a configuration, as reported by the process before the rounds.
    struct Ready {
        std::string fingerprint;  // hash of its picture
        std::string failure;      // why the configuration has no speed; else empty
        bool in_process = true;   // false: a driver renders in another process
    };
    using Rows = std::map<std::string, Ready>;

    // Time of a picture by the duel's clock, or the reason why there is none.
    struct Drawn {
        std::optional<double> seconds;
        std::string failure;
    };

    // Starts `program` with the arguments and `--on-demand`. Throws Error if it cannot be started.
    DuelProcess(const std::string& program, const std::vector<std::string>& arguments, DuelClock clock) : clock_(clock)
    {
        std::array<int, 2> pair{};
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) {
            throw Error(fmt::format("a socket: {}", std::strerror(errno)));
        }
        socket_.emplace(Descriptor(pair[0]));
        const Descriptor theirs(pair[1]);
        // Makes OpenMP's waiting threads sleep. Otherwise they would spin on the cores that the other program uses, and
        // the spinning would count as processor time.
        setenv("OMP_WAIT_POLICY", "passive", 1);
        std::vector<std::string> words{program};
        words.insert(words.end(), arguments.begin(), arguments.end());
        words.emplace_back("--on-demand");
        process_.emplace(ChildSetup{.words = std::move(words), .program = program, .input = theirs.number()});
    }

    // Closes the socket, which makes the process exit. Kills the process if it has not ended soon after.
    ~DuelProcess()
    {
        socket_.reset();
        process_->end(last_wait);
    }

    // Waits until the configurations are ready. Throws Error if the process ends first or sends an invalid message.
    void wait()
    {
        const Json hello = receive();
        try {
            if (hello.at("version") != on_demand_version) throw Error("is a bench with another version of duels");
            environment_ = hello.at("environment");
            for (const Json& row : hello.at("rows")) {
                const Json& failure = row.at("failure");
                rows_[row.at("name")] = {row.at("fingerprint"), failure.is_null() ? "" : failure.get<std::string>(),
                                         row.at("in_process")};
            }
        } catch (const nlohmann::json::exception&) {
            throw Error(no_answer);
        }
    }

    const Rows& rows() const { return rows_; }
    const Json& environment() const { return environment_; }

    // Makes the process render one picture of the configuration named `row`, and returns its time. Throws Error if the
    // process ends.
    Drawn draw(const std::string& row)
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
        if (failure == answer.end() || !failure->is_string()) throw Error(no_answer);
        return {.seconds = std::nullopt, .failure = failure->get<std::string>()};
    }

private:
    static constexpr const char* no_answer = "does not answer as bench does";

    Json receive()
    {
        std::string line;
        if (!socket_->receive(line, [this] { return process_->ends_within(0); })) throw Error(how_it_ended());
        check_json_depth(line, "its answer");
        Json json = Json::parse(line, nullptr, false);
        if (!json.is_object()) throw Error(no_answer);
        return json;
    }

    std::string how_it_ended()
    {
        if (!process_->ends_within(last_wait)) return "closed its socket";
        const Ended& ended = process_->end();
        if (ended.signal != 0) return fmt::format("was ended by signal {}", ended.signal);
        return fmt::format(
            "ended with {}{}", ended.code,
            ended.code == exit_usage ? ", as a bench without duels does that has no option --on-demand" : "");
    }

    DuelClock clock_;
    std::optional<ChildProcess> process_;
    std::optional<LineSocket> socket_;
    Rows rows_;
    Json environment_;
};

void check_program(const std::string& program)
{
    if (!std::filesystem::is_regular_file(program) || access(program.c_str(), X_OK) != 0) {
        throw InputError(fmt::format("bench duel: {}: no program, expected the file of a bench", program));
    }
}

// Returns the arguments of both programs. `first`: true for the first run, which verifies the pictures.
std::vector<std::string> arguments_of(const DuelOptions& options, bool first)
{
    std::vector<std::string> words = words_of(options.rows);
    words.emplace_back("--quiet");
    if (!first) words.emplace_back("--unproven");
    return words;
}

class RunningDuel {
public:
    RunningDuel(const DuelOptions& options, const std::function<void(double)>& progress)
        : options_(options), progress_(progress), random_(options.rows.seed)
    {
        duel_.old_side.program = options.old_program;
        duel_.new_side.program = options.new_program;
        duel_.clock = options.clock;
        duel_.margin = options.margin;
        duel_.rounds = options.rounds;
    }

    Duel run()
    {
        const Steadiness steadiness;
        for (int number = 0; number < options_.runs; ++number) {
            try {
                run(number);
                ++duel_.runs;
            } catch (const Error& error) {
                duel_.warnings.push_back(fmt::format("run {}: {}", number, error.what()));
                say("bench: {}, the other runs are kept\n", printable(duel_.warnings.back()));
            }
        }
        if (duel_.runs == 0) throw Error("bench duel: " + duel_.warnings.back());
        for (std::string& warning : steadiness.warnings({})) duel_.warnings.push_back(std::move(warning));
        return std::move(duel_);
    }

private:
    // Returns work(). If work() throws an Error, adds the side ("old" or "new") to its message.
    template <class Work>
    static auto of(const char* side, const Work& work)
    {
        try {
            return work();
        } catch (const Error& error) {
            throw Error(fmt::format("the {} program {}", side, error.what()));
        }
    }

    void run(int number)
    {
        const std::vector<std::string> arguments = arguments_of(options_, duel_.runs == 0);
        DuelProcess old_one(options_.old_program, arguments, options_.clock);
        DuelProcess new_one(options_.new_program, arguments, options_.clock);
        of("old", [&] { old_one.wait(); });
        of("new", [&] { new_one.wait(); });
        if (duel_.runs == 0) {
            duel_.old_side.environment = old_one.environment();
            duel_.new_side.environment = new_one.environment();
            first_ = {old_one.rows(), new_one.rows()};
            duel_.rows.clear();
            for (const auto& [name, row] : old_one.rows()) duel_.rows.push_back({.name = name});
            for (const auto& [name, row] : new_one.rows()) {
                if (!old_one.rows().contains(name)) duel_.rows.push_back({.name = name});
            }
            if (duel_.rows.empty()) throw Error("has no row that can be measured here (bench --list shows the rows)");
        }
        for (DuelRow& row : duel_.rows) look(row, old_one, new_one);
        std::vector<std::vector<DuelPair>> pairs(duel_.rows.size());
        for (int round = 0; round < options_.rounds; ++round) {
            std::vector<std::size_t> order;
            for (std::size_t i = 0; i < duel_.rows.size(); ++i) order.push_back(i);
            std::ranges::shuffle(order, random_);
            for (const std::size_t i : order)
                draw(duel_.rows[i], pairs[i], {.run = number, .round = round}, old_one, new_one);
            progress_((number + (round + 1.0) / options_.rounds) / options_.runs);
        }
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            duel_.rows[i].pairs.insert(duel_.rows[i].pairs.end(), pairs[i].begin(), pairs[i].end());
        }
    }

    // Returns the reason why a program's configuration cannot be timed in this run; empty if it can be timed. `now`:
    // the program's process in this run. `first`: the program's configurations in the first run.
    std::string failure_of(const std::string& name, const DuelProcess& now, const DuelProcess::Rows& first) const
    {
        const auto found = now.rows().find(name);
        if (found == now.rows().end()) return "there is no such row";
        if (!found->second.failure.empty()) return found->second.failure;
        if (options_.clock == DuelClock::processor && !found->second.in_process) {
            return "a driver renders it in another process, whose processor time is unknown";
        }
        const auto before = first.find(name);
        const bool same = before != first.end() && before->second.fingerprint == found->second.fingerprint;
        return same ? std::string() : "the picture differs from the one verified in the first run";
    }

    void look(DuelRow& row, const DuelProcess& old_one, const DuelProcess& new_one)
    {
        if (row.old_failure.empty()) row.old_failure = failure_of(row.name, old_one, first_.first);
        if (row.new_failure.empty()) row.new_failure = failure_of(row.name, new_one, first_.second);
        if (!row.old_failure.empty() || !row.new_failure.empty()) return;
        row.same_picture = old_one.rows().at(row.name).fingerprint == new_one.rows().at(row.name).fingerprint;
    }

    void draw(DuelRow& row, std::vector<DuelPair>& pairs, DuelPair pair, DuelProcess& old_one, DuelProcess& new_one)
    {
        if (!row.old_failure.empty() || !row.new_failure.empty()) return;
        DuelProcess::Drawn by_old;
        DuelProcess::Drawn by_new;
        const auto old_draws = [&] { by_old = of("old", [&] { return old_one.draw(row.name); }); };
        const auto new_draws = [&] { by_new = of("new", [&] { return new_one.draw(row.name); }); };
        const bool old_first = random_() % 2 == 0;
        if (old_first) old_draws();
        new_draws();
        if (!old_first) old_draws();
        row.old_failure = by_old.failure;
        row.new_failure = by_new.failure;
        if (!by_old.seconds || !by_new.seconds) return;
        pair.old_seconds = *by_old.seconds;
        pair.new_seconds = *by_new.seconds;
        pairs.push_back(pair);
    }

    const DuelOptions& options_;
    const std::function<void(double)>& progress_;
    std::mt19937_64 random_;
    Duel duel_;
    std::pair<DuelProcess::Rows, DuelProcess::Rows> first_;
};

}  // namespace

Duel run_duel(const DuelOptions& options, const std::function<void(double)>& progress)
{
    check_program(options.old_program);
    check_program(options.new_program);
    return RunningDuel(options, progress).run();
}

}  // namespace mandelmarch::bench
