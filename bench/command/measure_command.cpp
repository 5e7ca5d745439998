// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <csignal>
#include <memory>

#include "apps/cli/options.h"
#include "bench/command/commands.h"
#include "bench/command/display.h"
#include "bench/command/outputs.h"
#include "bench/result/result_file.h"
#include "bench/print/printers.h"
#include "bench/statistics/table.h"
#include "bench/measure/interruption.h"
#include "bench/measure/peaks.h"
#include "bench/measure/environment.h"
#include "bench/measure/runs.h"
#include "bench/measure/session.h"
#include "bench/print/demo_table.h"
#include "bench/measure/cases.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

struct Measurement {
    Options options;
    Result result;
    Outputs outputs;
    std::string earlier;  // stored result to continue; empty: none
    bool list = false, wide = false;
    bool quiet = false;  // no table and no progress, as in further runs
};

void list(Registry& registry, const Options& options)
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

void add_options(CLI::App& app, Registry& registry, Measurement& m)
{
    Options& o = m.options;
    add_selection(app, registry, o);
    app.add_option("--repetitions", o.repetitions,
                   "exact number of rounds (default: until the medians' confidence intervals are narrow, within limits "
                   "on rounds and time)")
        ->check(whole(1, 100'000));
    app.add_option("--runs", o.runs, "number of processes that repeat the study, one after the other")
        ->check(whole(1, 1000))
        ->capture_default_str();
    app.add_option("--continue", m.earlier, "stored result that runs are added to, until there are --runs of them")
        ->needs("--runs");
    app.add_option(
           "--budget", o.budget,
           "time for the timed rounds, in seconds (default: 150 s minus the time already spent, but at least 15 s "
           "and at most 100 s); no effect with --repetitions")
        ->check(real(0, 1e6));
    app.add_option("--seed", o.seed, "seed for the order of configurations in each round")
        ->check(whole(0, 1'000'000'000))
        ->capture_default_str();
    app.add_flag("--move-eye", o.move_eye,
                 "move the eye in each round, so that a picture kept from an earlier run is noticed (default with "
                 "program:PROGRAM)");
    m.outputs.option(app, "--json", "write all results and samples as JSON to this file (-: standard output)",
                     [&] { return text_of(facts_of(m.result)); });
    m.outputs.option(app, "--csv", "write one line per configuration to this file (-: standard output)",
                     [&] { return to_csv(m.result); });
    app.add_flag("--list", m.list, "list configurations and studies; measure nothing");
    app.add_flag("--wide", m.wide, "print all columns, in long lines");
    app.add_flag("--peaks,!--no-peaks", o.peaks,
                 "measure (default) or skip the peak rate of multiply-adds of every device");
    app.add_option("--run", o.run)->check(whole(0, 1000))->group("");
    app.add_flag("--quiet", m.quiet)->group("");
}

// Returns the arguments to pass on to further runs: all except those that write files, choose an output format or
// start further runs.
std::vector<std::string> inherited(const std::vector<std::string>& arguments)
{
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        const auto is = [&](const std::string& name) { return word == name || word.starts_with(name + "="); };
        if (is("--json") || is("--csv") || is("--runs") || is("--continue")) {
            if (word.find('=') == std::string::npos) ++i;
        } else if (word != "--wide") {
            kept.push_back(word);
        }
    }
    return kept;
}

// Returns the result to continue. Throws InputError if its further runs could not be those of this command.
Result continued(const Measurement& m, const nlohmann::ordered_json& here)
{
    Result earlier = read_result(m.earlier);
    const auto where = [&](const std::string& study, const nlohmann::ordered_json& environment) {
        return fmt::format("{} of revision {} on {}", study, environment.at("git").at("revision").dump(),
                           environment.at("cpu").at("platform").dump());
    };
    const std::string found = where(earlier.study, earlier.environment);
    const std::string expected = where(std::string(m.options.study->name), here);
    if (found != expected) throw InputError(fmt::format("{}: {} found, expected {}", m.earlier, found, expected));
    if (earlier.runs >= m.options.runs) {
        throw InputError(
            fmt::format("{}: it has {} runs, expected fewer than --runs {}", m.earlier, earlier.runs, m.options.runs));
    }
    return earlier;
}

Outputs::Done measured(Measurement& m, Registry& registry, const std::vector<std::string>& arguments)
{
    const int runs = m.options.runs;
    Display display(m.quiet);
    const auto start = Clock::now();
    if (m.earlier.empty()) {
        m.result = measure(registry, m.options, [&](const Step& step) { display.show(step); });
    } else {
        m.result = continued(m, environment(registry));
    }
    if (runs > 1) {
        m.result = with_further_runs(std::move(m.result), runs, [&](int run) {
            display.show({"further runs", static_cast<double>(run) / runs, fmt::format("run {} of {}", run + 1, runs)},
                         start);
            return run_again(inherited(arguments), run);
        });
    }
    display.finish();
    for (const Row& row : m.result.rows) {
        if (row.failed()) say("bench: {}: {}\n", row.name(), printable(row.failure));
    }
    const bool passed = !m.result.failed() && m.result.runs == runs;
    if (m.quiet) return {"", passed};
    return {m.result.study == demo_study ? demo_table(m.result) : to_console(m.result, m.wide), passed};
}

}  // namespace

Run measure_command(CLI::App& app, Registry& registry, const std::vector<std::string>& arguments)
{
    const auto m = std::make_shared<Measurement>();
    add_options(app, registry, *m);
    return [m, &registry, arguments, command = &app]() -> int {
        if (m->list) {
            refuse_others(*command, "--list",
                          {"--list", "--backend", "--fractal", "--precision", "--mode", "--scene", "--size", "--study",
                           "--filter"});
            list(registry, m->options);
            return exit_success;
        }
        // Outputs must not replace the parameter file or the program of program:PROGRAM.
        std::vector<std::string> read{m->options.scene};
        for (const std::string& name : m->options.backends) {
            const std::string argument = name.substr(name.find(':') + 1);
            if (argument != name) read.insert(read.end(), {argument, argument.substr(0, argument.find(' '))});
        }
        const int code = m->outputs.deliver(read, [&] { return measured(*m, registry, arguments); });
        if (interrupted() != 0) {
            flush_stdout();
            std::signal(interrupted(), SIG_DFL);
            std::raise(interrupted());
        }
        return code;
    };
}

Run peak_command(CLI::App& app, Registry& registry)
{
    const auto options = std::make_shared<Options>();
    add_devices(app, registry, *options);
    return [options, &registry]() -> int {
        Display display;
        const auto peaks = measure_peaks(
            registry, *options, [&](const Step& step) { display.show(step); },
            [&](const Peak& peak) { return options->selects(peak.backend); });
        display.finish();
        Table table({"<platform", "<backend", ">dev", "<precision", ">GFLOP/s"});
        for (const Peak& p : peaks) {
            table.add(p.platform, p.backend, p.device, name_of(p.precision), fmt::format("{:.1f}", 1e-9 * p.rate));
        }
        print("{}", table.text());
        return exit_success;
    };
}

}  // namespace mandelmarch::bench
