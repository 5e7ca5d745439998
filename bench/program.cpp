// SPDX-License-Identifier: Apache-2.0
#include "bench/program.h"

#include "apps/cli/options.h"
#include "bench/command/commands.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/version.h"

namespace mandelmarch::bench {
namespace {

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
    int code = exit_success;
    MeasureCommand measure{.arguments = {argv + 1, argv + argc}};
    measure.declare(app, registry);
    app.callback([&] {
        if (app.get_subcommands().empty()) code = measure.run(registry);
    });
    const auto add = [&](auto& command, const char* name, const char* about) {
        CLI::App* sub = app.add_subcommand(name, about);
        command.declare(*sub, registry);
        sub->callback([&app, &command, &registry, &code, name] {
            refuse_options(app, name);
            code = command.run(registry);
        });
    };
    CompareCommand compare;
    PrintCommand csv{"FILE", "result file written by --json", stored_csv};
    PrintCommand json{"FILE", "result file written by --json", derived_json};
    PrintCommand schema{"KIND", "kind of file", schema_text};
    PeakCommand peak;
    PortabilityCommand portability;
    RandomCommand random;
    EquivalenceCommand equivalence;
    add(compare, "compare", "compare two result files, OLD.json NEW.json; exit code 1 on a regression");
    add(csv, "csv", "print a stored result, FILE.json, as --csv does");
    add(json, "json", "print a stored file, FILE.json, with all figures that follow from what it holds");
    add(schema, "schema", "print the JSON Schema of a kind of file: result, random, ...");
    add(peak, "peak", "measure the peak rate of multiply-adds of every device");
    add(portability, "portability", "compute Pennycook's performance portability over result files: FILES...");
    add(random, "random", "measure fast mode's error on random scenes");
    add(equivalence, "equivalence", "check exact mode bit for bit on random scenes, with every backend");
    return parse_arguments(app, "bench", argc, argv).value_or(code);
}

}  // namespace mandelmarch::bench
