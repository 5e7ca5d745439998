// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <csignal>

#include "apps/cli/options.h"
#include "bench/command/commands.h"
#include "bench/command/display.h"
#include "bench/measure/cases.h"
#include "bench/measure/environment.h"
#include "bench/measure/interruption.h"
#include "bench/measure/peaks.h"
#include "bench/measure/runs.h"
#include "bench/measure/session.h"
#include "bench/print/printers.h"
#include "bench/result/result_file.h"
#include "bench/statistics/table.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

void print_list(const Registry& registry, const Options& options)
{
    for (const Case& one : cases_of(registry, options)) {
        if (one.backend != nullptr) {
            print("{}\n", one.row.name());
        } else {
            print("{}: unavailable: {}\n", one.row.backend, one.row.unavailable);
        }
    }
    print("\nstudies (--study NAME; --study NAME --list lists its configurations)\n");
    for (const Study& study : studies()) {
        print("  {:<12} {}{}\n", study.name, study.about,
              study.axes.empty() ? "" : fmt::format(" [{}]", study.axes.front().name));
    }
}

// Returns the result to continue. Throws InputError if its further runs could not be those of this command.
Result continued(const MeasureCommand& command, const Registry& registry)
{
    Result earlier = read_result(command.earlier);
    const auto where = [&](const std::string& study, const nlohmann::ordered_json& environment) {
        return fmt::format("{} of revision {} on {}", study, environment.at("git").at("revision").dump(),
                           environment.at("cpu").at("platform").dump());
    };
    const std::string found = where(earlier.study, earlier.environment);
    const std::string expected = where(std::string(command.options.study->name), environment(registry));
    if (found != expected) throw InputError(fmt::format("{}: {} found, expected {}", command.earlier, found, expected));
    for (const std::string& name : command.options.backends) {
        if (std::ranges::find(earlier.rows, name, &Row::backend) != earlier.rows.end()) continue;
        throw InputError(
            fmt::format("{}: it has no row of {}, expected the backends of --backend", command.earlier, name));
    }
    if (earlier.runs >= command.options.runs) {
        throw InputError(fmt::format("{}: it has {} runs, expected fewer than --runs {}", command.earlier, earlier.runs,
                                     command.options.runs));
    }
    return earlier;
}

Texts measured(const MeasureCommand& command, Registry& registry)
{
    const int runs = command.options.runs;
    Display display;
    const auto start = Clock::now();
    Result result = command.earlier.empty()
                        ? measure(registry, command.options, [&](const Step& step) { display.show(step); })
                        : continued(command, registry);
    if (runs > 1) {
        result = with_further_runs(std::move(result), runs, [&](int run) {
            display.show({"further runs", static_cast<double>(run) / runs, fmt::format("run {} of {}", run + 1, runs)},
                         start);
            return run_again(command.arguments, run);
        });
    }
    display.finish();
    for (const Row& row : result.rows) {
        if (row.failed()) say("bench: {}: {}\n", row.name(), printable(row.failure));
    }
    return {.table = to_console(result, command.wide),
            .passed = !result.failed() && result.runs == runs,
            .files = {{"--json", text_of(facts_of(result))}, {"--csv", to_csv(result)}}};
}

}  // namespace

void MeasureCommand::declare(CLI::App& app, Registry& registry)
{
    add_selection(app, registry, options);
    app.add_option("--repetitions", options.repetitions,
                   "exact number of rounds (default: until the medians' confidence intervals are narrow, within limits "
                   "on rounds and time)")
        ->check(whole(1, 100'000));
    app.add_option("--runs", options.runs, "number of processes that repeat the study, one after the other")
        ->check(whole(1, 1000))
        ->capture_default_str();
    app.add_option("--continue", earlier, "stored result that runs are added to, until there are --runs of them")
        ->needs("--runs");
    app.add_option(
           "--budget", options.budget,
           "time for the timed rounds, in seconds (default: 150 s minus the time already spent, but at least 15 s "
           "and at most 100 s); no effect with --repetitions")
        ->check(real(0, 1e6));
    app.add_option("--seed", options.seed, "seed for the order of configurations in each round")
        ->check(whole(0, 1'000'000'000))
        ->capture_default_str();
    app.add_flag("--move-eye", options.move_eye,
                 "move the eye in each round, so that a picture kept from an earlier run is noticed (default with "
                 "program:PROGRAM)");
    outputs.declare(app, "--json", "all results and samples as JSON");
    outputs.declare(app, "--csv", "one line per configuration");
    app.add_flag("--wide", wide, "print all columns, in long lines");
    app.add_flag("--peaks,!--no-peaks", options.peaks,
                 "measure (default) or skip the peak rate of multiply-adds of every device");
    app.add_option("--run", options.run)->check(whole(0, 1000))->group("");
    CLI::Option* listing = app.add_flag("--list", list, "list configurations and studies; measure nothing");
    for (const char* other : {"--repetitions", "--runs", "--continue", "--budget", "--seed", "--move-eye", "--json",
                              "--csv", "--wide", "--peaks"}) {
        listing->excludes(other);
    }
}

int MeasureCommand::run(Registry& registry) const
{
    if (list) {
        print_list(registry, options);
        return exit_success;
    }
    int code = exit_success;
    if (options.run > 0) {  // the process of a further run
        const Result result = measure(registry, options, [](const Step&) {});
        print(std::string_view(text_of(facts_of(result))));
        code = result.failed() ? exit_failure : exit_success;
    } else {
        // Outputs must not replace the parameter file or the program of program:PROGRAM.
        std::vector<std::string> read{options.scene};
        for (const std::string& name : options.backends) {
            const std::string argument = name.substr(name.find(':') + 1);
            if (argument != name) read.insert(read.end(), {argument, argument.substr(0, argument.find(' '))});
        }
        code = outputs.deliver(read, [&] { return measured(*this, registry); });
    }
    if (interrupted() != 0) {
        flush_stdout();
        std::signal(interrupted(), SIG_DFL);
        std::raise(interrupted());
    }
    return code;
}

void PeakCommand::declare(CLI::App& app, Registry& registry) { add_devices(app, registry, options); }

int PeakCommand::run(Registry& registry) const
{
    Display display;
    const auto peaks = measure_peaks(
        registry, options, [&](const Step& step) { display.show(step); },
        [&](const Peak& peak) { return options.selects(peak.backend); });
    display.finish();
    Table table({"<platform", "<backend", ">dev", "<precision", ">GFLOP/s"});
    for (const Peak& p : peaks) {
        table.add(p.platform, p.backend, p.device, name_of(p.precision), fmt::format("{:.1f}", 1e-9 * p.rate));
    }
    print("{}", table.text());
    return exit_success;
}

}  // namespace mandelmarch::bench
