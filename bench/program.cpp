#include "bench/program.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/progress_bar.h"
#include "bench/command_line.h"
#include "bench/compare.h"
#include "bench/figures.h"
#include "bench/launches.h"
#include "bench/portability.h"
#include "bench/report.h"
#include "bench/session.h"
#include "core/base/console.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

// What is being done, on stderr: a bar on a terminal, else a line for each new thing.
class Display {
public:
    explicit Display(bool quiet) : quiet_(quiet) {}

    void show(const std::string& what, double share)
    {
        if (quiet_) return;
        if (what != what_) {
            what_ = what;
            bar_ = std::make_unique<ProgressBar>(what);
            fmt::print(stderr, "bench: {}\n", what);
        }
        bar_->show(share);
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
            fmt::print("{}\n", one.row.name());
        } else if (!names_only) {
            fmt::print("{}: unavailable: {}\n", one.row.backend, one.row.unavailable);
        }
    }
    if (names_only) return;
    fmt::print("\nstudies (--study NAME; with --list the rows of that one)\n");
    for (const Study& study : studies()) {
        fmt::print("  {:<12} {}{}\n", study.name, study.about,
                   study.varies.empty() ? "" : fmt::format(" [{}]", study.varies));
    }
}

int run(const Registry& registry, const CommandLine& line)
{
    const Options& options = line.options;
    if (options.list || line.list_names) {
        list(registry, options, line.list_names);
        return exit_fine;
    }
    Display display(line.quiet);
    Outcome outcome =
        measure(registry, options, [&](const std::string& what, double share) { display.show(what, share); });
    Result& result = outcome.result;
    if (options.launches > 1) {
        std::vector<Result> results{std::move(result)};
        for (int launch = 1; launch < options.launches; ++launch) {
            display.show("further launches", static_cast<double>(launch) / options.launches);
            results.push_back(launch_again(line.arguments, launch));
        }
        result = merged(std::move(results));
    }
    display.finish();

    if (!options.json.empty()) write_text(options.json, to_json(result).dump(1) + "\n");
    if (!options.csv.empty()) write_text(options.csv, to_csv(result));
    if (!options.out.empty()) write_text(options.out, to_google_benchmark(result, outcome.runs, options.out_format));
    if (!options.format.empty()) {
        write_text("-", to_google_benchmark(result, outcome.runs, options.format));
    } else if (!line.quiet) {
        // Data and table do not mix.
        const std::string table = to_console(result, options.wide);
        if (options.json == "-" || options.csv == "-") {
            fmt::print(stderr, "{}", table);
        } else {
            write_text("-", table);
        }
    }
    if (!result.failed()) return exit_fine;
    for (const Row& row : result.rows) {
        if (row.failed()) fmt::print(stderr, "bench: {}: {}\n", row.name(), row.failure);
    }
    return exit_failure;
}

int peak(const Registry& registry, const CommandLine& line)
{
    Display display(line.quiet);
    const auto peaks = measure_peaks(registry, line.options,
                                     [&](const std::string& what, double share) { display.show(what, share); });
    display.finish();
    std::string text =
        fmt::format("{:<44} {:<8} {:>3} {:<6} {:>9}\n", "platform", "backend", "dev", "number", "GFLOP/s");
    for (const Peak& p : peaks) {
        text += fmt::format("{:<44} {:<8} {:>3} {:<6} {:>9.1f}\n", p.platform, p.backend, p.device,
                            name_of(p.precision), 1e-9 * p.rate);
    }
    write_text("-", text);
    return exit_fine;
}

int portability_of(const CommandLine& line)
{
    std::vector<Result> results;
    for (const std::string& file : line.files) results.push_back(read_result(file));
    const auto found = portability(results);
    if (!line.options.json.empty()) write_text(line.options.json, to_json(found).dump(1) + "\n");
    if (line.options.json != "-") write_text("-", to_console(found));
    return exit_fine;
}

int random_scenes(const Registry& registry, const CommandLine& line)
{
    Display display(line.quiet);
    const RandomResult result =
        measure_random(registry, line.random, [&](double share) { display.show("canonical pictures", share); });
    display.finish();
    const std::string& json = line.options.json;
    if (!json.empty()) write_text(json, to_json(result).dump(1) + "\n");
    if (json != "-") write_text("-", to_console(result));
    return result.held() ? exit_fine : exit_failure;
}

// Each discrepancy at once, on stderr, with what draws it again.
int equivalence(const Registry& registry, const CommandLine& line)
{
    namespace fs = std::filesystem;
    Display display(line.quiet);
    const auto show = [&](const Discrepancy& d) {
        std::string parameters = d.parameters;
        if (!line.folder.empty()) {
            const std::string file = (fs::path(line.folder) / (d.scene + ".dat")).string();
            fs::create_directories(line.folder);
            write_text(file, d.parameters);
            parameters = file + "\n";
        }
        say("bench: {}: {}: {}\n{}", d.scene, d.subject, d.what, parameters);
    };
    const EquivalenceResult result =
        compare_backends(registry, line.equivalence, show, [&](double share) { display.show("random scenes", share); });
    display.finish();
    const std::string& json = line.options.json;
    if (!json.empty()) write_text(json, to_json(result).dump(1) + "\n");
    if (json != "-") write_text("-", to_console(result));
    return result.discrepancies.empty() ? exit_fine : exit_failure;
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
        case Command::compare: {
            const ComparedResults comparison =
                compare_results(read_result(line.files.at(0)), read_result(line.files.at(1)));
            write_text("-", to_console(comparison));
            return comparison.regression() ? exit_failure : exit_fine;
        }
        default: return run(registry, line);
    }
}

}  // namespace mandelmarch::bench
