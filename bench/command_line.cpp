// SPDX-License-Identifier: Apache-2.0
#include "bench/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "apps/backend_option.h"
#include "apps/option_values.h"
#include "bench/study.h"
#include "core/base/error.h"
#include "core/base/version.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

constexpr int most_repetitions = 100'000;

// Google Benchmark's flags; what would change how it measures is refused, as the harness decides that.
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

// Numbers, as they were given.
struct Texts {
    std::string repetitions, launches, launch, seed, budget, scenes, extremes, extreme_seed, margin, clock, limit;
};

void add_options(CLI::App& app, CommandLine& line, Texts& texts)
{
    Options& o = line.options;
    app.add_option("--backend", o.backend, "all, or names of backends, openmp,opencl say")->capture_default_str();
    app.add_option("--fractal", o.fractal,
                   fmt::format("all ({}), or one fractal's name", fmt::join(fractals_of("all"), " and ")))
        ->capture_default_str();
    app.add_option("--precision", o.precision, "all, float or double")
        ->check(CLI::IsMember({"all", "float", "double"}))
        ->capture_default_str();
    app.add_option("--mode", o.mode, "all, exact or fast (default: all; in sweeps exact)")
        ->check(CLI::IsMember({"all", "exact", "fast"}));
    app.add_option("--size", o.size, "WxH in pixels (default 540x540)");
    app.add_option("--study", o.study, study_names())->capture_default_str();
    app.add_option("--repetitions", texts.repetitions,
                   "rounds, exactly so many (default: until the intervals are narrow)");
    app.add_option("--launches", texts.launches, "processes that measure one after the other (default 1)");
    app.add_option("--budget", texts.budget,
                   "seconds that the timed rounds may take without --repetitions (default: so that all ends in three "
                   "minutes)");
    app.add_option("--seed", texts.seed, "of the order of rows in each round (default 1)");
    app.add_option("--json", o.json, "write everything to this file (- is standard output)");
    app.add_option("--csv", o.csv, "write a line a row to this file (- is standard output)");
    app.add_flag("--list", o.list, "list rows and studies, measure nothing");
    app.add_flag("--wide", o.wide, "print everything that was measured, in long lines");
    app.add_flag("--peaks,!--no-peaks", o.peaks, "measure what multiply-adds reach on every device (default), or not");
    app.add_option("--launch", texts.launch)->group("");
    app.add_flag("--quiet", line.quiet)->group("");
    app.add_flag("--on-demand")->group("");
    app.add_flag("--unproven", line.unproven)->group("");
}

// Further launches write no files of their own and start no launches.
std::vector<std::string> inherited(const std::vector<std::string>& arguments)
{
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        const auto is = [&](const std::string& name) { return word == name || word.starts_with(name + "="); };
        if (is("--json") || is("--csv") || is("--launches")) {
            if (word.find('=') == std::string::npos) ++i;
        } else if (word != "--wide" && !is("--benchmark_format") && !is("--benchmark_out") &&
                   !is("--benchmark_out_format")) {
            kept.push_back(word);
        }
    }
    return kept;
}

// What a duel takes of a run's options.
void take_duel(CommandLine& line, bool launches, const std::string& margin, const std::string& clock)
{
    const Options& o = line.options;
    if (!o.csv.empty() || o.wide || o.list || !o.peaks || o.budget || !o.format.empty() || !o.out.empty() ||
        line.list_names) {
        throw InputError(
            "bench duel: options of a run given, expected --launches, --repetitions, --json and what chooses rows");
    }
    line.command = Command::duel;
    if (launches) line.duel.launches = o.launches;
    if (line.duel.launches < 2) throw InputError("--launches: 1 given, expected 2 or more for a duel");
    line.duel.rounds = o.repetitions.value_or(line.duel.rounds);
    if (clock == name_of(DuelClock::processor)) line.duel.clock = DuelClock::processor;
    if (!margin.empty()) line.duel.margin = real_option("margin", margin, 0, 1);
}

// What a race takes of a run's options.
void take_race(CommandLine& line, bool launches, const std::string& limit)
{
    const Options& o = line.options;
    if (!o.csv.empty() || o.wide || o.list || !o.peaks || o.budget || launches || !o.format.empty() || !o.out.empty() ||
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

    CLI::App app("bench: proves that all backends draw the same picture, then times them.");
    Texts texts;
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.set_version_flag("--version", version_line("bench"));
    add_options(app, line, texts);
    add_isolation_option(app);
    app.require_subcommand(0, 1);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
    CLI::App* compare = app.add_subcommand("compare", "faster, slower, the same or undecided: OLD.json NEW.json");
    compare->add_option("FILES", line.files, "two result files of --json")->expected(2)->required();
    CLI::App* duel = app.add_subcommand(
        "duel", "two builds of bench in alternation, picture by picture: OLD NEW, and options that choose rows");
    duel->add_option("OLD", line.duel.old_program, "a program, build/old/bin/bench say")->required();
    duel->add_option("NEW", line.duel.new_program, "another")->required();
    duel->add_option("--margin", texts.margin, "a ratio within this of 1 is the same (default 0.01)");
    duel->add_option("--clock", texts.clock,
                     "wall (default): kernel time; processor: that of all threads, for a machine that others use")
        ->check(CLI::IsMember({"wall", "processor"}));
    duel->fallthrough();
    duel->footer(
        "--backend, --fractal, --precision, --mode, --size, --study, --benchmark_filter choose rows, --launches (10) "
        "and --repetitions (20) say how often, --json where to.");
    CLI::App* race = app.add_subcommand(
        "race", "any programs beside ours: PROGRAM..., each run as PROGRAM scene.dat, which names the picture's file");
    race->add_option("PROGRAM", line.race.programs, "files that can be run")->required();
    race->add_option("--scene", line.race.scene, "a parameter file, of --fractal (default: the official scene)");
    race->add_option("--limit", texts.limit, "seconds that a program may take for a picture (default 60)");
    race->fallthrough();
    race->footer(
        "--fractal (mandelbulb), --size, --backend of ours (openmp), --repetitions (7), --seed, --json. docs/race.md "
        "explains the table.");
    CLI::App* csv = app.add_subcommand("csv", "a stored result as --csv writes it, on standard output: FILE.json");
    csv->add_option("FILE", line.files, "a result file of --json")->expected(1)->required();
    CLI::App* json = app.add_subcommand(
        "json", "a stored result with its figures derived anew from its samples, on standard output: FILE.json");
    json->add_option("FILE", line.files, "a result file of --json")->expected(1)->required();
    CLI::App* peak = app.add_subcommand("peak", "measures the multiply-add peak of every device");
    CLI::App* portability = app.add_subcommand("portability", "Pennycook's performance portability over result files");
    portability->add_option("FILES", line.files, "result files of --json, and folders that have some")->required();
    portability->add_option("--json", line.options.json, "write it, cascades included, to this file");
    portability->add_option("--csv", line.options.csv,
                            "write the rows behind it to this file, for p3-analysis-library");
    CLI::App* divergence = app.add_subcommand(
        "divergence", "code divergence: how many lines of code of what a backend needs are its own, from the sources");
    divergence->add_option("FOLDER", line.folder, "the program's sources (default: the current folder)");
    divergence->add_option("--json", line.options.json, "write it to this file (- is standard output)");
    divergence->add_option("--csv", line.options.csv,
                           "write which lines each backend needs to this file, for p3-analysis-library");
    CLI::App* random = app.add_subcommand("random", "fast mode's pictures of random scenes beside canonical ones");
    random->add_option("--backend", line.random.backend,
                       "the backend that draws them (default: the text's on this machine's cores)");
    random->add_option("--fractal", line.random.fractal, "all, as above, or one fractal's name")->capture_default_str();
    random->add_option("--without", line.random.without, "techniques to switch off, `trial` say");
    random->add_option("--scenes", texts.scenes, "scenes of a fractal in each set (default 60)");
    random->add_option("--sets", line.random.sets, "seeds, one for each set")->delimiter(',')->capture_default_str();
    random->add_option("--json", line.options.json, "write every scene to this file (- is standard output)");
    CLI::App* equivalence =
        app.add_subcommand("equivalence", "exact pictures of random scenes by every backend, bit for bit");
    equivalence->add_option("--backend", line.equivalence.backend, "all, or names of backends, openmp,opencl say")
        ->capture_default_str();
    equivalence->add_option("--fractal", line.equivalence.fractal, "all, or one fractal's name")->capture_default_str();
    equivalence->add_option("--scenes", texts.extremes, "scenes in all (default 1000)");
    equivalence->add_option("--seed", texts.extreme_seed, "of the scenes (default 1)");
    equivalence->add_option("--folder", line.folder, "write the parameter files of scenes that differ here");
    equivalence->add_option("--json", line.options.json, "write everything to this file (- is standard output)");
    app.footer(
        "Google Benchmark's --benchmark_filter, _repetitions, _format, _out, _out_format and _list_tests work, too.\n"
        "Exit codes: 0 fine, 1 a wrong picture, a regression or a failure, 2 wrong arguments, 77 the one backend asked "
        "for is not available. docs/bench-output.md explains every figure.");
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
    if (given(option("--launches"))) o.launches = whole_option("launches", texts.launches, 1, 1000);
    if (given(option("--launch"))) o.launch = whole_option("launch", texts.launch, 0, 1000);
    if (given(option("--seed"))) o.seed = large_option("seed", texts.seed, 1'000'000'000);
    if (given(option("--budget"))) o.budget = real_option("budget", texts.budget, 0, 1e6);
    if (compare->parsed()) line.command = Command::compare;
    if (given(option("--on-demand"))) line.command = Command::on_demand;
    if (duel->parsed()) take_duel(line, given(option("--launches")), texts.margin, texts.clock);
    if (race->parsed()) take_race(line, given(option("--launches")), texts.limit);
    o.baselines = line.command == Command::run;
    if (json->parsed()) line.command = Command::json;
    if (csv->parsed()) line.command = Command::csv;
    if (peak->parsed()) line.command = Command::peak;
    if (portability->parsed()) line.command = Command::portability;
    if (divergence->parsed()) line.command = Command::divergence;
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
