// SPDX-License-Identifier: Apache-2.0
#include "bench/program.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/progress_bar.h"
#include "bench/command_line.h"
#include "bench/compare.h"
#include "bench/duel_run.h"
#include "bench/runs.h"
#include "bench/on_demand.h"
#include "bench/outputs.h"
#include "bench/portability.h"
#include "bench/report.h"
#include "bench/session.h"
#include "bench/study.h"
#include "core/base/console.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/stopwatch.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

// Progress on stderr: a bar on a terminal, else a line for each new phase.
class Display {
public:
    explicit Display(bool quiet) : quiet_(quiet) {}

    // `since`: start of the phase, from which the remaining time is estimated.
    void show(const Step& step, Clock::time_point since = Clock::now())
    {
        if (quiet_) return;
        if (step.what != what_) {
            what_ = step.what;
            bar_.reset();
            bar_ = std::make_unique<ProgressBar>(what_, since);
            if (!bar_->on_terminal()) say("bench: {}\n", what_);
        }
        bar_->show(step.share, step.detail);
    }

    void finish() { bar_.reset(); }

private:
    bool quiet_;
    std::string what_;
    std::unique_ptr<ProgressBar> bar_;
};

void list(const Registry& registry, const Options& options, bool names_only)
{
    for (const Case& one : cases_of(registry, options)) {
        if (one.backend != nullptr) {
            print("{}\n", one.row.name());
        } else if (!names_only) {
            print("{}: unavailable: {}\n", one.row.backend, one.row.unavailable);
        }
    }
    if (names_only) return;
    print("\nstudies (--study NAME; with --list the rows of that one)\n");
    for (const Study& study : studies()) {
        print("  {:<12} {}{}\n", study.name, study.about,
              study.axis.empty() ? "" : fmt::format(" [{}]", study.axis));
    }
}

int run(const Registry& registry, const CommandLine& line)
{
    const Options& options = line.options;
    if (options.list || line.list_names) {
        list(registry, options, line.list_names);
        return exit_success;
    }
    Result result;
    Outputs outputs;
    outputs.add("--json", options.json, [&] { return text_of(json_of(result)); });
    outputs.add("--csv", options.csv, [&] { return to_csv(result); });
    outputs.add("--benchmark_out", options.out, [&] { return to_google_benchmark(result, options.out_format); });
    outputs.add("--benchmark_format", options.format.empty() ? "" : "-",
                [&] { return to_google_benchmark(result, options.format); });
    outputs.check();

    Display display(line.quiet);
    const auto start = Clock::now();
    result = measure(registry, options, [&](const Step& step) { display.show(step); });
    if (options.runs > 1) {
        result = with_further_runs(std::move(result), options.runs, [&](int run) {
            display.show({"further runs", static_cast<double>(run) / options.runs,
                          fmt::format("run {} of {}", run + 1, options.runs)},
                         start);
            return run_again(line.arguments, run);
        });
    }
    display.finish();

    bool ok = outputs.write_files();
    for (const Row& row : result.rows) {
        if (row.failed()) say("bench: {}: {}\n", row.name(), printable(row.failure));
    }
    ok = ok && !result.failed() && result.runs == options.runs;
    // With --benchmark_format, only data in that format goes to standard output.
    if (!line.quiet && options.format.empty()) {
        const std::string table = to_console(result, options.wide);
        if (outputs.on_stdout()) {
            say(std::string_view(table));
        } else {
            print(std::string_view(table));
        }
    }
    outputs.write_stdout();
    return ok ? exit_success : exit_failure;
}

int peak(const Registry& registry, const CommandLine& line)
{
    Display display(line.quiet);
    const auto peaks = measure_peaks(registry, line.options, [&](const Step& step) { display.show(step); });
    display.finish();
    std::string text =
        fmt::format("{:<44} {:<8} {:>3} {:<9} {:>9}\n", "platform", "backend", "dev", "precision", "GFLOP/s");
    for (const Peak& p : peaks) {
        text += fmt::format("{:<44} {:<8} {:>3} {:<9} {:>9.1f}\n", p.platform, p.backend, p.device,
                            name_of(p.precision), 1e-9 * p.rate);
    }
    print(std::string_view(text));
    return exit_success;
}

int portability_of(const CommandLine& line)
{
    std::vector<Portability> found;
    Outputs outputs;
    outputs.add("--json", line.options.json, [&] { return text_of(json_of(found)); });
    outputs.add("--csv", line.options.csv, [&] { return to_csv(found); });
    const std::vector<std::string> files = result_files(line.files);
    outputs.check(files);
    std::vector<Result> results;
    for (const std::string& file : files) {
        if (auto result = read_if_result(file)) {
            results.push_back(std::move(*result));
        } else {
            say("bench: {}: no result of bench, left out\n", printable(file));
        }
    }
    if (results.empty())
        throw InputError("bench portability: no result of bench among the files, expected one at least");
    found = portability(results);
    const bool written = outputs.write_files();
    if (!outputs.on_stdout()) print(std::string_view(to_console(found)));
    outputs.write_stdout();
    return written ? exit_success : exit_failure;
}

int random_scenes(const Registry& registry, const CommandLine& line)
{
    RandomResult result;
    Outputs outputs;
    outputs.add("--json", line.options.json, [&] { return text_of(json_of(result)); });
    outputs.check();
    Display display(line.quiet);
    result = measure_random(registry, line.random, [&](double share) { display.show({"canonical pictures", share}); });
    display.finish();
    const bool written = outputs.write_files();
    if (!outputs.on_stdout()) print(std::string_view(to_console(result)));
    outputs.write_stdout();
    return written && result.held() ? exit_success : exit_failure;
}

int compare_files(const std::string& old_file, const std::string& new_file)
{
    const ComparedResults comparison = compare_results(read_result(old_file), read_result(new_file));
    print(std::string_view(to_console(comparison)));
    return comparison.regression() ? exit_failure : exit_success;
}

int duel(const CommandLine& line)
{
    Duel found;
    std::vector<Judged> judged;
    Outputs outputs;
    outputs.add("--json", line.options.json, [&] { return text_of(json_of(found, judged)); });
    outputs.check({line.duel.old_program, line.duel.new_program});
    Display display(line.quiet);
    found = run_duel(line.duel, line.options, [&](double share) { display.show({"duel", share}); });
    display.finish();
    judged = judge(found);
    const bool written = outputs.write_files();
    const std::string table = to_console(found, judged);
    if (outputs.on_stdout()) {
        say(std::string_view(table));
    } else {
        print(std::string_view(table));
    }
    outputs.write_stdout();
    const bool whole = found.runs == line.duel.runs;
    return written && whole && !regression(judged) ? exit_success : exit_failure;
}

int race(const Registry& registry, const CommandLine& line)
{
    Race found;
    Outputs outputs;
    outputs.add("--json", line.options.json, [&] { return text_of(json_of(found)); });
    std::vector<std::string> read = line.race.programs;
    if (!line.race.scene.empty()) read.push_back(line.race.scene);
    outputs.check(read);
    Display display(line.quiet);
    found = run_race(line.race, line.options, registry, [&](double share) { display.show({"race", share}); });
    display.finish();
    const bool written = outputs.write_files();
    const std::string table = to_console(found);
    if (outputs.on_stdout()) {
        say(std::string_view(table));
    } else {
        print(std::string_view(table));
    }
    outputs.write_stdout();
    return written && found.held() ? exit_success : exit_failure;
}

int on_demand(const Registry& registry, const CommandLine& line)
{
    draw_on_demand(registry, line.options, !line.unproven);
    return exit_success;
}

// Runs `bench equivalence`. Prints each discrepancy on stderr as soon as it is found, with a parameter file, or its
// path, that reproduces it.
int equivalence(const Registry& registry, const CommandLine& line)
{
    namespace fs = std::filesystem;
    Display display(line.quiet);
    const auto show = [&](const Discrepancy& d) {
        std::string parameters = d.parameters;
        if (!line.folder.empty()) {
            const std::string file = (fs::path(line.folder) / (d.scene + ".dat")).string();
            fs::create_directories(line.folder);
            write_file(file, d.parameters);
            parameters = file + "\n";
        }
        say("bench: {}: {}: {}\n{}", d.scene, d.subject, d.what, parameters);
    };
    EquivalenceResult result;
    Outputs outputs;
    outputs.add("--json", line.options.json, [&] { return text_of(json_of(result)); });
    outputs.check();
    result = compare_backends(registry, line.equivalence, show, [&](double share) {
        display.show({"random scenes", share});
    });
    display.finish();
    const bool written = outputs.write_files();
    if (!outputs.on_stdout()) print(std::string_view(to_console(result)));
    outputs.write_stdout();
    return written && result.failures.empty() && result.discrepancies.empty() ? exit_success : exit_failure;
}

}  // namespace

int bench_program(const Registry& registry, int argc, char** argv)
{
    const CommandLine line = parse_command_line(argc, argv);
    switch (line.command) {
        case Command::help: return line.exit_code;
        case Command::peak: return peak(registry, line);
        case Command::random: return random_scenes(registry, line);
        case Command::equivalence: return equivalence(registry, line);
        case Command::portability: return portability_of(line);
        case Command::duel: return duel(line);
        case Command::race: return race(registry, line);
        case Command::on_demand: return on_demand(registry, line);
        case Command::compare: return compare_files(line.files.at(0), line.files.at(1));
        case Command::json:
            print(std::string_view(text_of(json_of(read_result(line.files.at(0))))));
            return exit_success;
        case Command::csv: print(std::string_view(to_csv(read_result(line.files.at(0))))); return exit_success;
        default: return run(registry, line);
    }
}

}  // namespace mandelmarch::bench
