// SPDX-License-Identifier: Apache-2.0
// Commands that compare pictures of random scenes (random, equivalence).
#include <fmt/format.h>

#include <filesystem>

#include "apps/cli/options.h"
#include "bench/command/commands.h"
#include "bench/command/display.h"
#include "bench/command/outputs.h"
#include "bench/fidelity/equivalence.h"
#include "bench/fidelity/random_scenes.h"
#include "bench/measure/environment.h"
#include "bench/measure/options.h"
#include "bench/result/result_file.h"
#include "core/os/output_file.h"
#include "core/text/error.h"

namespace mandelmarch::bench {
namespace {

// Returns a function that shows the finished fraction of the phase.
std::function<void(double)> shown(Display& display, const char* phase)
{
    return [&display, phase](double share) { display.show({phase, share}); };
}

// Prints a discrepancy on stderr, with the parameter file that reproduces it. If `folder` is given, writes that file to
// it and prints the file's path instead.
void show(const Discrepancy& d, const std::string& folder)
{
    namespace fs = std::filesystem;
    std::string parameters = d.parameters;
    if (!folder.empty()) {
        const std::string file = (fs::path(folder) / (d.scene + ".dat")).string();
        fs::create_directories(folder);
        write_file(file, d.parameters, NamedBy::program);
        parameters = file + "\n";
    }
    say("bench: {}: {}: {}\n{}", d.scene, d.subject, d.what, parameters);
}

}  // namespace

void RandomCommand::declare(CLI::App& app, Registry& /*registry*/)
{
    app.add_option("--backend", options.backend, "backend to test (default: openmp)");
    add_fractal(app, options.fractals, "fractals to render: all that bench studies by default, or one name");
    app.add_option("--without", options.without,
                   "optimisations to disable, separated by commas; names as for `render --without`");
    app.add_option("--scenes", options.scenes, "scenes per fractal and set")
        ->check(whole(1, 100'000))
        ->capture_default_str();
    app.add_option("--sets", options.sets, "seeds, one per set, separated by commas")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
        ->capture_default_str();
    outputs.declare(app, "--json", "the results of all scenes as JSON");
}

int RandomCommand::run(Registry& registry) const
{
    return outputs.deliver({}, [&]() -> Texts {
        Display display;
        RandomResult found = measure_random(registry, options, shown(display, "canonical pictures"));
        found.environment = environment(registry);
        return {.table = to_console(found), .passed = found.passed(), .files = {{"--json", text_of(facts_of(found))}}};
    });
}

void EquivalenceCommand::declare(CLI::App& app, Registry& registry)
{
    const auto set_backends = [this, &registry](const std::string& text) {
        options.backends = parse_backends(registry, text);
        for (const std::string& name : options.backends) {
            if (!registry.find(name)->info().replays) continue;
            throw InputError(fmt::format("--backend: '{}' given, expected a backend of this build", name));
        }
    };
    app.add_option_function<std::string>("--backend", set_backends,
                                         "backend to check: all, or a list such as openmp,reference")
        ->default_str("all");
    add_fractal(app, options.fractals, "fractals to render: all, or one name");
    app.add_option("--scenes", options.scenes, "number of scenes in all")
        ->check(whole(1, 10'000'000))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "seed for the scenes")
        ->check(whole(0, 1'000'000'000))
        ->capture_default_str();
    app.add_option("--folder", folder, "folder for the parameter files of scenes whose pictures differ");
    outputs.declare(app, "--json", "all results as JSON");
}

int EquivalenceCommand::run(Registry& registry) const
{
    return outputs.deliver({}, [&]() -> Texts {
        Display display;
        EquivalenceResult found = compare_backends(
            registry, options, [&](const Discrepancy& d) { show(d, folder); }, shown(display, "random scenes"));
        found.environment = environment(registry);
        const std::string title =
            fmt::format("Exact pictures of {} random scenes, seed {}, against {} --simd-width 1\n", options.scenes,
                        options.seed, registry.with(Role::host).name());
        return {.table = title + to_console(found),
                .passed = found.failures.empty() && found.discrepancies.empty(),
                .files = {{"--json", text_of(facts_of(found))}}};
    });
}

}  // namespace mandelmarch::bench
