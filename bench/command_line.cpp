// SPDX-License-Identifier: Apache-2.0
#include "bench/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "cli/backend_option.h"
#include "cli/option_values.h"
#include "bench/study.h"
#include "core/base/error.h"
#include "core/base/version.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

constexpr int most_repetitions = 100'000;

// Parses one of Google Benchmark's flags. Throws InputError for all flags but those below, as they would change how
// bench measures.
void take_google_flag(const std::string& flag, CommandLine& line)
{
    const auto equals = flag.find('=');
    const std::string name = flag.substr(0, equals);
    const std::string value = equals == std::string::npos ? "true" : flag.substr(equals + 1);
    Options& o = line.options;
    const auto check_format = [&]() -> const std::string& {
        if (value != "console" && value != "json" && value != "csv") {
            throw InputError(fmt::format("{}: '{}' given, expected console, json or csv", name, value));
        }
        return value;
    };
    if (name == "--benchmark_filter") {
        o.filter = value;
    } else if (name == "--benchmark_repetitions") {
        o.repetitions = whole_option("benchmark_repetitions", value, 1, most_repetitions);
    } else if (name == "--benchmark_format") {
        o.format = check_format();
    } else if (name == "--benchmark_out") {
        o.out = value;
    } else if (name == "--benchmark_out_format") {
        o.out_format = check_format();
    } else if (name == "--benchmark_list_tests") {
        line.list_names = value != "false" && value != "0";
    } else {
        throw InputError(fmt::format(
            "{}: not an option of bench, expected --benchmark_filter, _repetitions, _format, _out, _out_format or "
            "_list_tests",
            name));
    }
}

std::string study_names()
{
    std::string names;
    for (const Study& study : studies()) names += fmt::format("{}{}", names.empty() ? "" : ", ", study.name);
    return names;
}

// Values of options as the user wrote them, before they are parsed.
struct Texts {
    std::string repetitions, runs, run, seed, budget, scenes, extremes, extreme_seed, margin, clock, limit;
};

void add_options(CLI::App& app, CommandLine& line, Texts& texts)
{
    Options& o = line.options;
    app.add_option("--backend", o.backend, "backend to measure: all, or a list such as openmp,opencl")
        ->capture_default_str();
    app.add_option("--fractal", o.fractal,
                   fmt::format("fractal to measure: all ({}), or one name", fmt::join(fractals_of("all"), " and ")))
        ->capture_default_str();
    app.add_option("--precision", o.precision, "precision to measure: all, float or double")
        ->check(CLI::IsMember({"all", "float", "double"}))
        ->capture_default_str();
    app.add_option("--mode", o.mode, "mode to measure: all, exact or fast (default: all; in sweeps exact)")
        ->check(CLI::IsMember({"all", "exact", "fast"}));
    app.add_option("--size", o.size, "picture size, WxH in pixels (default 540x540)");
    app.add_option("--study", o.study, "what to vary: " + study_names())->capture_default_str();
    app.add_option("--repetitions", texts.repetitions,
                   "exact number of rounds (default: until intervals are narrow enough)");
    app.add_option("--runs", texts.runs,
                   "number of processes that repeat the study, one after the other (default 1)");
    app.add_option("--budget", texts.budget,
                   "seconds for the timed rounds, without --repetitions (default: about three minutes in all)");
    app.add_option("--seed", texts.seed, "seed for the order of configurations in each round (default 1)");
    app.add_option("--json", o.json, "write all results and samples as JSON to this file (-: standard output)");
    app.add_option("--csv", o.csv, "write one line per configuration to this file (-: standard output)");
    app.add_flag("--list", o.list, "list configurations and studies; measure nothing");
    app.add_flag("--wide", o.wide, "print all columns, in long lines");
    app.add_flag("--peaks,!--no-peaks", o.peaks, "measure (default) or skip the multiply-add peak of every device");
    app.add_option("--run", texts.run)->group("");
    app.add_flag("--quiet", line.quiet)->group("");
    app.add_flag("--on-demand")->group("");
    app.add_flag("--unproven", line.unproven)->group("");
}

// Returns the arguments to pass on to further runs: all except those that write files, choose an output format or
// start further runs.
std::vector<std::string> inherited(const std::vector<std::string>& arguments)
{
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        const auto is = [&](const std::string& name) { return word == name || word.starts_with(name + "="); };
        if (is("--json") || is("--csv") || is("--runs")) {
            if (word.find('=') == std::string::npos) ++i;
        } else if (word != "--wide" && !is("--benchmark_format") && !is("--benchmark_out") &&
                   !is("--benchmark_out_format")) {
            kept.push_back(word);
        }
    }
    return kept;
}

// Sets a duel's options from those of a plain run. Throws InputError for options that a duel does not support.
void take_duel(CommandLine& line, bool runs, const std::string& margin, const std::string& clock)
{
    const Options& o = line.options;
    if (!o.csv.empty() || o.wide || o.list || !o.peaks || o.budget || !o.format.empty() || !o.out.empty() ||
        line.list_names) {
        throw InputError(
            "bench duel: options of a run given, expected --runs, --repetitions, --json and what chooses rows");
    }
    line.command = Command::duel;
    if (runs) line.duel.runs = o.runs;
    if (line.duel.runs < 2) throw InputError("--runs: 1 given, expected 2 or more for a duel");
    line.duel.rounds = o.repetitions.value_or(line.duel.rounds);
    if (clock == name_of(DuelClock::processor)) line.duel.clock = DuelClock::processor;
    if (!margin.empty()) line.duel.margin = real_option("margin", margin, 0, 1);
}

// Sets a race's options from those of a plain run. Throws InputError for options that a race does not support.
void take_race(CommandLine& line, bool runs, const std::string& limit)
{
    const Options& o = line.options;
    if (!o.csv.empty() || o.wide || o.list || !o.peaks || o.budget || runs || !o.format.empty() || !o.out.empty() ||
        !o.filter.empty() || !o.mode.empty() || o.precision != "all" || o.study != standard_study || line.list_names) {
        throw InputError(
            "bench race: options of a run given, expected --backend, --fractal, --size, --repetitions, --seed or "
            "--json");
    }
    line.command = Command::race;
    line.race.rounds = o.repetitions.value_or(line.race.rounds);
    if (!limit.empty()) line.race.limit = real_option("limit", limit, 0.01, 1e5);
}

}  // namespace

CommandLine parse_command_line(int argc, char** argv)
{
    CommandLine line;
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.starts_with("--benchmark_")) {
            take_google_flag(word, line);
        } else {
            words.push_back(word);
        }
    }
    line.arguments = inherited({argv + 1, argv + argc});

    CLI::App app("bench: verifies that all backends render the same picture, then times them.");
    Texts texts;
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.set_version_flag("--version", version_line("bench"));
    add_options(app, line, texts);
    add_isolation_option(app);
    app.require_subcommand(0, 1);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
    CLI::App* compare =
        app.add_subcommand("compare", "compare two result files, OLD.json NEW.json; exit code 1 on a regression");
    compare->add_option("FILES", line.files, "two result files written by --json")->expected(2)->required();
    CLI::App* duel = app.add_subcommand(
        "duel", "measure two builds of bench in alternation: OLD NEW, and options that select configurations");
    duel->add_option("OLD", line.duel.old_program, "old build of bench, for example build/old/bin/bench")->required();
    duel->add_option("NEW", line.duel.new_program, "new build of bench")->required();
    duel->add_option("--margin", texts.margin, "ratios within this distance of 1 count as same (default 0.01)");
    duel->add_option("--clock", texts.clock,
                     "wall (default): kernel time; processor: time of all threads, for a shared machine")
        ->check(CLI::IsMember({"wall", "processor"}));
    duel->fallthrough();
    duel->footer(
        "Select configurations with --backend, --fractal, --precision, --mode, --size, --study and --benchmark_filter. "
        "--runs N: processes (default 10); --repetitions N: rounds in each (default 20); --json FILE: write the "
        "result.");
    CLI::App* race =
        app.add_subcommand("race", "time other renderers next to ours: PROGRAM..., each run as `PROGRAM scene.dat`");
    race->add_option("PROGRAM", line.race.programs, "executable files")->required();
    race->add_option("--scene", line.race.scene, "parameter file for --fractal (default: the official scene)");
    race->add_option("--limit", texts.limit, "time limit per picture, in seconds (default 60)");
    race->fallthrough();
    race->footer(
        "Also used: --fractal NAME (default mandelbulb), --size WxH, --backend NAME of our renderer (default openmp), "
        "--repetitions N (default 7), --seed N, --json FILE. See docs/race.md for the table.");
    CLI::App* csv = app.add_subcommand("csv", "print a stored result, FILE.json, as --csv does");
    csv->add_option("FILE", line.files, "result file written by --json")->expected(1)->required();
    CLI::App* json =
        app.add_subcommand("json", "print a stored result, FILE.json, with all figures recomputed from its samples");
    json->add_option("FILE", line.files, "result file written by --json")->expected(1)->required();
    CLI::App* peak = app.add_subcommand("peak", "measure the multiply-add peak of every device");
    CLI::App* portability =
        app.add_subcommand("portability", "compute Pennycook's performance portability over result files: FILES...");
    portability->add_option("FILES", line.files, "result files written by --json, or folders of them")->required();
    portability->add_option("--json", line.options.json,
                            "write the metric, with cascades, as JSON to this file (-: standard output)");
    portability->add_option("--csv", line.options.csv,
                            "write pixels per second on each platform, for p3-analysis-library (-: standard output)");
    CLI::App* random = app.add_subcommand("random", "measure fast mode's error on random scenes");
    random->add_option("--backend", line.random.backend, "backend to test (default: openmp)");
    random
        ->add_option("--fractal", line.random.fractal,
                     "fractals of the scenes: all that bench studies by default, or one name")
        ->capture_default_str();
    random->add_option("--without", line.random.without,
                       "optimisations to disable, separated by commas; same names as `render --without`");
    random->add_option("--scenes", texts.scenes, "scenes per fractal and set (default 60)");
    random->add_option("--sets", line.random.sets, "seeds, one per set, separated by commas")
        ->delimiter(',')
        ->capture_default_str();
    random->add_option("--json", line.options.json,
                       "write the results of all scenes as JSON to this file (-: standard output)");
    CLI::App* equivalence =
        app.add_subcommand("equivalence", "check exact mode bit for bit on random scenes, with every backend");
    equivalence
        ->add_option("--backend", line.equivalence.backend, "backend to check: all, or a list such as openmp,opencl")
        ->capture_default_str();
    equivalence->add_option("--fractal", line.equivalence.fractal, "fractals of the scenes: all, or one name")
        ->capture_default_str();
    equivalence->add_option("--scenes", texts.extremes, "number of scenes in all (default 1000)");
    equivalence->add_option("--seed", texts.extreme_seed, "seed for the scenes (default 1)");
    equivalence->add_option("--folder", line.folder, "folder for the parameter files of scenes whose pictures differ");
    equivalence->add_option("--json", line.options.json, "write all results as JSON to this file (-: standard output)");
    app.footer(
        "Google Benchmark's --benchmark_filter, _repetitions, _format, _out, _out_format and _list_tests are "
        "supported.\n"
        "Exit codes: 0 success, 1 wrong picture, regression or failure, 2 wrong arguments, 77 the only selected "
        "backend "
        "is not available. docs/bench-output.md explains every figure.");
    try {
        std::ranges::reverse(words);
        app.parse(words);
    } catch (const CLI::Success& answer) {  // --help, --version
        line.command = Command::help;
        line.exit_code = app.exit(answer);
        return line;
    } catch (const CLI::ParseError& error) {
        throw InputError(fmt::format("bench: {} (--help lists the options)", error.what()));
    }
    Options& o = line.options;
    const auto given = [](const CLI::Option* option) { return option->count() > 0; };
    const auto option = [&](const char* name) { return app.get_option(name); };
    if (given(option("--repetitions")))
        o.repetitions = whole_option("repetitions", texts.repetitions, 1, most_repetitions);
    if (given(option("--runs"))) o.runs = whole_option("runs", texts.runs, 1, 1000);
    if (given(option("--run"))) o.run = whole_option("run", texts.run, 0, 1000);
    if (given(option("--seed"))) o.seed = large_option("seed", texts.seed, 1'000'000'000);
    if (given(option("--budget"))) o.budget = real_option("budget", texts.budget, 0, 1e6);
    if (compare->parsed()) line.command = Command::compare;
    if (given(option("--on-demand"))) line.command = Command::on_demand;
    if (duel->parsed()) take_duel(line, given(option("--runs")), texts.margin, texts.clock);
    if (race->parsed()) take_race(line, given(option("--runs")), texts.limit);
    o.baselines = line.command == Command::run;
    if (json->parsed()) line.command = Command::json;
    if (csv->parsed()) line.command = Command::csv;
    if (peak->parsed()) line.command = Command::peak;
    if (portability->parsed()) line.command = Command::portability;
    if (random->parsed()) line.command = Command::random;
    if (equivalence->parsed()) line.command = Command::equivalence;
    if (given(random->get_option("--scenes"))) line.random.scenes = whole_option("scenes", texts.scenes, 1, 100'000);
    if (given(equivalence->get_option("--scenes"))) {
        line.equivalence.scenes = whole_option("scenes", texts.extremes, 1, 10'000'000);
    }
    if (given(equivalence->get_option("--seed"))) {
        line.equivalence.seed = static_cast<unsigned>(large_option("seed", texts.extreme_seed, 1'000'000'000));
    }
    static_cast<void>(study_named(o.study));
    static_cast<void>(fractals_of(o.fractal));
    static_cast<void>(fractals_of(line.random.fractal));
    static_cast<void>(size_of(o));
    return line;
}

}  // namespace mandelmarch::bench
