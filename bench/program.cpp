// SPDX-License-Identifier: Apache-2.0
#include "bench/program.h"

#include "apps/cli/options.h"
#include "bench/command/commands.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/version.h"

namespace mandelmarch::bench {
namespace {

struct Command {
    const char* name;
    const char* about;
    Run (*declare)(CLI::App& app, Registry& registry);
};

constexpr Command commands[] = {
    {"compare", "compare two result files, OLD.json NEW.json; exit code 1 on a regression", compare_command},
    {"csv", "print a stored result, FILE.json, as --csv does", csv_command},
    {"json", "print a stored file, FILE.json, with all figures that follow from what it holds", json_command},
    {"schema", "print the JSON Schema of a kind of file: result, random, ...", schema_command},
    {"peak", "measure the peak rate of multiply-adds of every device", peak_command},
    {"portability", "compute Pennycook's performance portability over result files: FILES...", portability_command},
    {"random", "measure fast mode's error on random scenes", random_command},
    {"equivalence", "check exact mode bit for bit on random scenes, with every backend", equivalence_command}};

// Throws InputError if an option of measurements was given before a command, because the command would ignore it.
void refuse_options(const CLI::App& app, const std::string& command)
{
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() == 0 || option->get_name() == "--no-isolation") continue;
        throw InputError("bench: " + option->get_name() + " before " + command + " given, expected after it");
    }
}

}  // namespace

int bench_program(Registry registry, int argc, char** argv)
{
    CLI::App app("bench: verifies that all backends render the same picture, then times them.");
    app.set_version_flag("--version", version_line("bench"));
    app.require_subcommand(0, 1);
    app.footer(
        "Give a command's options after its name; `bench COMMAND --help` lists them.\n"
        "Exit codes: 0 success, 1 wrong picture, regression or failure, 2 wrong arguments, 77 the only selected "
        "backend is not available. docs/bench-output.md explains every figure." +
        environment_help("bench"));
    add_isolation_option(app);
    // The last value counts if an option is given twice.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    const Run measure = measure_command(app, registry, {argv + 1, argv + argc});
    std::vector<std::pair<const CLI::App*, Run>> runs;
    for (const Command& command : commands) {
        CLI::App* sub = app.add_subcommand(command.name, command.about);
        runs.emplace_back(sub, command.declare(*sub, registry));
    }
    if (const auto done = parse_arguments(app, "bench", argc, argv)) return *done;
    for (const auto& [sub, run] : runs) {
        if (!sub->parsed()) continue;
        refuse_options(app, sub->get_name());
        return run();
    }
    return measure();
}

}  // namespace mandelmarch::bench
