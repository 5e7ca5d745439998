// SPDX-License-Identifier: Apache-2.0
// Commands that compare pictures of random scenes (random, equivalence).
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/cli/options.h"
#include "bench/command/commands.h"
#include "bench/command/display.h"
#include "bench/fidelity/equivalence.h"
#include "bench/command/outputs.h"
#include "bench/fidelity/random_scenes.h"
#include "bench/result/result_file.h"
#include "bench/measure/environment.h"
#include "bench/measure/options.h"
#include "core/text/error.h"
#include "core/os/output_file.h"

namespace mandelmarch::bench {
namespace {

template <class Options, class Found>
struct State {  // NOLINT(bugprone-exception-escape): moving ordered_json may throw
    Options options;
    Found found;
    Outputs outputs;
};

// Returns a function that shows the finished fraction of the phase.
std::function<void(double)> shown(Display& display, const char* phase)
{
    return [&display, phase](double share) { display.show({phase, share}); };
}

CLI::Option* add_fractal(CLI::App& app, std::vector<const Fractal*>& fractals, const char* about)
{
    return app
        .add_option_function<std::string>(
            "--fractal", [&](const std::string& text) { fractals = parse_fractals(text, fractals); }, about)
        ->default_str("all");
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

Run random_command(CLI::App& app, Registry& registry)
{
    const auto state = std::make_shared<State<RandomOptions, RandomResult>>();
    RandomOptions& o = state->options;
    o.fractals = default_fractals();
    app.add_option("--backend", o.backend, "backend to test (default: openmp)");
    add_fractal(app, o.fractals, "fractals to render: all that bench studies by default, or one name");
    app.add_option("--without", o.without,
                   "optimisations to disable, separated by commas; names as for `render --without`");
    app.add_option("--scenes", o.scenes, "scenes per fractal and set")->check(whole(1, 100'000))->capture_default_str();
    app.add_option("--sets", o.sets, "seeds, one per set, separated by commas")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
        ->capture_default_str();
    state->outputs.option(app, "--json", "write the results of all scenes as JSON to this file (-: standard output)",
                          [s = state.get()] { return text_of(facts_of(s->found)); });
    return [state, &registry] {
        return state->outputs.deliver({}, [&]() -> Outputs::Done {
            Display display;
            state->found = measure_random(registry, state->options, shown(display, "canonical pictures"));
            state->found.environment = environment(registry);
            return {to_console(state->found), state->found.passed()};
        });
    };
}

Run equivalence_command(CLI::App& app, Registry& registry)
{
    const auto state = std::make_shared<State<EquivalenceOptions, EquivalenceResult>>();
    EquivalenceOptions& o = state->options;
    const auto folder = std::make_shared<std::string>();
    app.add_option_function<std::string>(
           "--backend",
           [&](const std::string& text) {
               o.backends = parse_backends(registry, text);
               for (const std::string& name : o.backends) {
                   if (registry.find(name)->info().replays) {
                       throw InputError(fmt::format("--backend: '{}' given, expected a backend of this build", name));
                   }
               }
           },
           "backend to check: all, or a list such as openmp,reference")
        ->default_str("all");
    add_fractal(app, o.fractals, "fractals to render: all, or one name");
    app.add_option("--scenes", o.scenes, "number of scenes in all")->check(whole(1, 10'000'000))->capture_default_str();
    app.add_option("--seed", o.seed, "seed for the scenes")->check(whole(0, 1'000'000'000))->capture_default_str();
    app.add_option("--folder", *folder, "folder for the parameter files of scenes whose pictures differ");
    state->outputs.option(app, "--json", "write all results as JSON to this file (-: standard output)",
                          [s = state.get()] { return text_of(facts_of(s->found)); });
    return [state, folder, &registry] {
        return state->outputs.deliver({}, [&]() -> Outputs::Done {
            Display display;
            EquivalenceResult& found = state->found;
            found = compare_backends(
                registry, state->options, [&](const Discrepancy& d) { show(d, *folder); },
                shown(display, "random scenes"));
            found.environment = environment(registry);
            const std::string title =
                fmt::format("Exact pictures of {} random scenes, seed {}, against {} --simd-width 1\n",
                            state->options.scenes, state->options.seed, registry.with(Role::host).name());
            return {title + to_console(found), found.failures.empty() && found.discrepancies.empty()};
        });
    };
}

}  // namespace mandelmarch::bench
