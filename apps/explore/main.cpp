// SPDX-License-Identifier: Apache-2.0
// explore: flies through fractals in a window, on any backend.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <tuple>

#include "apps/explore/view/explorer.h"
#include "apps/explore/view/script.h"
#include "backends/all.h"
#include "apps/cli/arguments.h"
#include "apps/cli/option_values.h"
#include "core/text/console.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/version.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/os/program.h"

namespace {

using namespace mandelmarch;
using namespace mandelmarch::explore;

struct Options {
    std::string file;
    std::string fractal;
    std::string backend;
    std::optional<int> device;
    std::optional<Precision> precision;
    std::optional<Mode> mode;
    std::string size;
    std::string folder;
    std::string script;
};

Options parse_options(const Registry& registry, int argc, char** argv, std::optional<int>& done)
{
    CLI::App app("explore: flies through fractals in a window, on any backend; F1 lists the keys.");
    app.set_version_flag("--version", version_line("explore"));
    Options options;
    app.add_option("FILE", options.file, "parameter file (.dat) or path (.json) to open");
    app.add_option("--fractal", options.fractal, "fractal to open; for a .dat that names no fractal, its fractal");
    std::vector<std::string> names = registry.names();
    app.add_option("--backend", options.backend, "rendering backend (default: last used)")->check(CLI::IsMember(names));
    app.add_option("--device", options.device, "device of that backend, from 0")->check(whole(0, 1'000'000));
    add_choice(app, "--precision", options.precision, {{"double", Precision::f64}, {"float", Precision::f32}},
               "floating-point precision (default: last used)");
    add_choice(app, "--mode", options.mode, {{"exact", Mode::exact}, {"fast", Mode::fast}},
               "rendering mode (default: last used)");
    app.add_option("--size", options.size, "size of the window, WxH in pixels (default: last used)");
    app.add_option("--folder", options.folder,
                   "where to save views, pictures, paths and films (default: current folder)");
    app.add_option("--script", options.script, "run a script that simulates the user (see docs/explore.md)");
    app.footer(
        "Settings are kept in $XDG_CONFIG_HOME/mandelmarch/explore.json, except with --script.\n"
        "Exit codes: 0 success, 1 failure, 2 wrong arguments or a bad script, 77 no display." +
        environment_help("explore"));
    done = parse_arguments(app, "explore", argc, argv);
    return options;
}

Settings settings_of(const Options& options, const std::string& file, std::string& said)
{
    // With a script, the settings of earlier runs are not used.
    Settings settings = options.script.empty() ? read_settings(file, said) : Settings();
    if (!options.backend.empty()) settings.setup = {options.backend, 0, settings.setup.precision, settings.setup.mode};
    settings.setup.device = options.device.value_or(settings.setup.device);
    settings.setup.precision = options.precision.value_or(settings.setup.precision);
    settings.setup.mode = options.mode.value_or(settings.setup.mode);
    if (!options.size.empty()) std::tie(settings.width, settings.height) = size_option(options.size);
    return settings;
}

// Ends the process without calling destructors, because a driver that does not respond could make them wait for ever.
[[noreturn]] void leave(int code)
{
    std::fflush(nullptr);
    std::_Exit(code);
}

int body(int argc, char** argv)
{
    // Backends are created first, because they fork processes for drivers. A process must be forked before threads are
    // started and the window is opened.
    static const Registry registry = program_backends(argc, argv);
    std::optional<int> done;
    const Options options = parse_options(registry, argc, argv, done);
    if (done) return *done;
    if (!options.fractal.empty() && options.file.ends_with(".json")) {
        throw InputError(fmt::format("--fractal: not expected with {}, which names its fractal", options.file));
    }
    const Fractal& fractal = options.fractal.empty() ? fractals().front() : fractal_named(options.fractal);
    const Script script = options.script.empty() ? Script() : read_script(options.script);
    if (!options.folder.empty() && !std::filesystem::is_directory(options.folder)) {
        throw InputError(fmt::format("--folder: '{}' is not a folder", options.folder));
    }
    const std::string file = settings_file();
    std::string said;
    const Settings settings = settings_of(options, file, said);
    Window window("mandelmarch explore", settings.width, settings.height);
    Scene scene = official_scene(fractal);
    scene.colouring = settings.look;
    Model model(registry, settings, options.folder, scene);
    Explorer explorer(model, window);
    model.say(said);
    if (!options.file.empty()) model.open(options.file);
    explorer.run([&] {
        if (script) script(model, window, explorer);
    });
    if (!script) {
        try {
            write_settings(file, model.settings);
        } catch (const Error& error) {
            say("explore: {}\n", error.what());
        }
    }
    flush_stdout();
    leave(exit_success);
}

}  // namespace

int main(int argc, char** argv) { return mandelmarch::run_program("explore", body, argc, argv); }
