// SPDX-License-Identifier: Apache-2.0
// explore: flies through fractals in a window, on any backend.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <sstream>
#include <tuple>
#include <vector>

#include "apps/cli/options.h"
#include "apps/explore/actions/actions.h"
#include "apps/explore/view/explorer.h"
#include "backends/all.h"
#include "core/os/input_file.h"
#include "core/os/program.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/text/console.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/version.h"

namespace {

using namespace mandelmarch;
using namespace mandelmarch::explore;

// Scripts simulate the user, for tests. A line is the name of an action (actions.h), or one of three commands:
// `hold KEY FRAMES` holds a key, `rest` waits until all work has ended, and `tell` prints the state as a line of JSON.
constexpr int longest = 1'000'000;  // frames that a key is held, at most

struct ScriptLine {
    std::string name;     // an action or a command
    SDL_Keycode key = 0;  // the key that `hold` holds
    int frames = 0;       // the frames for which it does
    int frame = 0;        // number of frames since the line began
};

void push_key(SDL_Keycode key, const Window& window, bool down)
{
    SDL_Event event{};
    event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
    event.key.windowID = SDL_GetWindowID(window.handle());
    event.key.keysym.sym = key;
    SDL_PushEvent(&event);
}

// Performs a line, and is called in each frame until it returns true.
bool carry_out(const ScriptLine& line, Model& model, Window& window, Explorer& explorer)
{
    if (line.name == "hold") {
        const bool done = line.frame == line.frames;
        if (line.frame == 0 || done) push_key(line.key, window, !done);
        return done;
    }
    if (line.name == "rest") {
        return line.frame > 1 && explorer.at_rest() && !model.tasks_running();
    }
    if (line.name == "tell") {
        print("{}", explorer.state());
    } else {
        action_named(line.name)->perform(model);
    }
    return true;
}

ScriptLine parsed(const std::string& text)
{
    std::istringstream words(text);
    ScriptLine line;
    std::string key;
    std::string frames;
    words >> line.name >> key >> frames >> std::ws;
    if (line.name == "hold") {
        line.key = SDL_GetKeyFromName(key.c_str());
        if (line.key == SDLK_UNKNOWN) throw InputError(fmt::format("'{}' is not the name of a key", key));
        line.frames = whole_option("hold", frames, 1, longest);
    } else if (!key.empty() || (line.name != "rest" && line.name != "tell" && action_named(line.name) == nullptr)) {
        throw InputError(fmt::format("'{}', expected hold KEY FRAMES, rest, tell or the name of an action", text));
    }
    return line;
}

// Performs a script's lines up to one that must wait for the next frame. Must be called before each frame. Makes
// explore quit at the end of the script.
using Script = std::function<void(Model& model, Window& window, Explorer& explorer)>;

// Reads a script. Throws InputError with a message that begins with `file:line: `.
Script read_script(const std::string& file)
{
    std::istringstream in(text_of_file(file, "script"));
    std::vector<ScriptLine> lines;
    for (std::string text; std::getline(in, text);) {
        try {
            lines.push_back(parsed(text));
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}:{}: {}", file, lines.size() + 1, error.what()));
        }
    }
    return [lines, at = std::size_t{0}](Model& model, Window& window, Explorer& explorer) mutable {
        for (; at < lines.size(); ++at) {
            if (!carry_out(lines[at], model, window, explorer)) {
                ++lines[at].frame;
                return;
            }
        }
        model.quit = true;
    };
}

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
