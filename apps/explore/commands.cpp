// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/commands.h"

#include <fmt/format.h>

#include <array>

#include "apps/explore/explorer.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch::explore {
namespace {

void set(Explorer& explorer, const Setup& setup)
{
    explorer.remember();
    explorer.set_setup(setup);
    explorer.say(name_of(setup));
}

// Selects the next device of the backend or, after its last device, the next backend. As soon as all devices have been
// listed, backends without devices are skipped.
void next_backend(Explorer& explorer)
{
    const auto& backends = explorer.registry.backends();
    const auto& listings = explorer.devices.listings();
    Setup setup = explorer.panes.chosen().setup;
    std::size_t at = 0;
    while (at + 1 < backends.size() && backends[at]->name() != setup.backend) ++at;
    if (!listings.empty() && setup.device + 1 < static_cast<int>(listings[at].devices.size())) {
        ++setup.device;
        return set(explorer, setup);
    }
    for (std::size_t tried = 0; tried < backends.size(); ++tried) {
        at = (at + 1) % backends.size();
        if (listings.empty() || !listings[at].devices.empty()) break;
    }
    setup.backend = backends[at]->name();
    setup.device = 0;
    if (backends[at]->info().role == Role::reference) setup.precision = Precision::f64;
    set(explorer, setup);
}

void next_precision(Explorer& explorer)
{
    Setup setup = explorer.panes.chosen().setup;
    setup.precision = setup.precision == Precision::f32 ? Precision::f64 : Precision::f32;
    set(explorer, setup);
}

void next_mode(Explorer& explorer)
{
    Setup setup = explorer.panes.chosen().setup;
    setup.mode = setup.mode == Mode::fast ? Mode::exact : Mode::fast;
    set(explorer, setup);
}

void next_fractal(Explorer& explorer)
{
    const auto all = fractals();
    const auto at = static_cast<std::size_t>(explorer.scene.fractal - all.data());
    explorer.remember();
    explorer.set_scene(official_scene(all[(at + 1) % all.size()]));
    explorer.say(std::string(explorer.scene.fractal->name));
}

void next_colouring(Explorer& explorer)
{
    explorer.remember();
    explorer.scene.colouring = (explorer.scene.colouring + 1) % colouring_types;
    explorer.changed();
}

// Adds a pane with another precision or mode. If there are four panes already, only the first one stays.
void more_panes(Explorer& explorer)
{
    explorer.remember();
    Panes& panes = explorer.panes;
    const std::size_t count = panes.all().size() % most_panes + 1;
    panes.set_count(count);
    panes.choose(count - 1);
    explorer.changed();
    if (count == 1) return;
    Setup setup = panes.all().front()->setup;
    if (count == 2 || count == 4) setup.precision = setup.precision == Precision::f32 ? Precision::f64 : Precision::f32;
    if (count >= 3) setup.mode = setup.mode == Mode::fast ? Mode::exact : Mode::fast;
    explorer.set_setup(setup);
}

void begin_again(Explorer& explorer)
{
    explorer.remember();
    explorer.set_scene(official_scene(*explorer.scene.fractal));
}

void step_path(Explorer& explorer, double frames)
{
    if (!explorer.path_editor.has_path()) return explorer.say("there is no path: Ctrl+R records one");
    explorer.path_editor.playing = false;
    explorer.path_editor.go_to(explorer.path_editor.at() + frames);
    explorer.show_path();
}

void play(Explorer& explorer)
{
    if (!explorer.path_editor.has_path()) return explorer.say("there is no path: Ctrl+R records one");
    if (explorer.path_editor.recording()) explorer.toggle_recording();
    PathEditor& path_editor = explorer.path_editor;
    path_editor.playing = !path_editor.playing;
    if (path_editor.playing && path_editor.at() + 1 >= static_cast<double>(path_editor.frames())) path_editor.go_to(0);
}

void plan_tour(Explorer& explorer)
{
    explorer.path_editor.plan(explorer.scene, static_cast<std::uint64_t>(explorer.tour_seed), explorer.tour_frames);
    explorer.paths = true;
    explorer.say("planning a tour");
}

void full_screen(Explorer& explorer)
{
    SDL_Window* window = explorer.window.handle();
    const bool is = (SDL_GetWindowFlags(window) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
    SDL_SetWindowFullscreen(window, is ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
}

void focus(Explorer& explorer)
{
    if (ImGui::GetIO().NavActive && ImGui::GetIO().WantCaptureKeyboard) {
        ImGui::SetWindowFocus(nullptr);
    } else {
        explorer.focus_panel();
    }
}

constexpr std::array table{
    Command{SDLK_F1, false, "this help", [](Explorer& e) { e.help = !e.help; }},
    Command{SDLK_F2, false, "panel", [](Explorer& e) { e.settings.panel = !e.settings.panel; }},
    Command{SDLK_ESCAPE, false, "go to the panel or back; arrow keys and Enter work there", focus},
    Command{SDLK_F3, false, "statistics", [](Explorer& e) { e.settings.statistics = !e.settings.statistics; }},
    Command{SDLK_F4, false, "next backend or device", next_backend},
    Command{SDLK_F5, false, "float or double", next_precision},
    Command{SDLK_F6, false, "exact or fast", next_mode},
    Command{SDLK_F7, false, "next fractal", next_fractal},
    Command{SDLK_F8, false, "next colouring type", next_colouring},
    Command{SDLK_F9, false, "side by side: two, three, four, one", more_panes},
    Command{SDLK_F10, false, "next pane", [](Explorer& e) { e.panes.choose(e.panes.chosen_number() + 1); }},
    Command{SDLK_m, false, "mark differing pixels or not",
            [](Explorer& e) {
                e.panes.marks = !e.panes.marks;
                e.changed();
            },
            true},
    Command{SDLK_F11, false, "full screen", full_screen},
    Command{SDLK_HOME, false, "reset the view to the official scene", begin_again, true},
    Command{SDLK_c, false, "fly through walls or stop at them",
            [](Explorer& e) {
                e.motion.collides = !e.motion.collides;
                e.say(e.motion.collides ? "walls stop the flight" : "the flight goes through walls");
            },
            true},
    Command{SDLK_z, true, "undo", [](Explorer& e) { e.undo(); }},
    Command{SDLK_y, true, "redo", [](Explorer& e) { e.redo(); }},
    Command{SDLK_s, true, "save the view as a parameter file", [](Explorer& e) { e.save_view(); }},
    Command{SDLK_c, true, "copy the view's parameter file", [](Explorer& e) { e.copy_view(); }},
    Command{SDLK_v, true, "show the view of the clipboard's parameter file", [](Explorer& e) { e.paste_view(); }},
    Command{SDLK_p, true, "save a picture, in the size set in the panel", [](Explorer& e) { e.save_picture(); }},
    Command{SDLK_r, true, "record a path, or end the recording", [](Explorer& e) { e.toggle_recording(); }},
    Command{SDLK_l, true, "smooth the path", [](Explorer& e) { e.guarded([&] { e.path_editor.smooth(); }); }},
    Command{SDLK_d, true, "save the path", [](Explorer& e) { e.save_path(); }},
    Command{SDLK_m, true, "render a film of the path", [](Explorer& e) { e.film_path(); }},
    Command{SDLK_t, true, "plan a tour from the seed", plan_tour},
    Command{SDLK_F12, false, "paths panel", [](Explorer& e) { e.paths = !e.paths; }},
    Command{SDLK_SPACE, false, "play the path, or stop", play, true},
    Command{SDLK_COMMA, false, "one frame back", [](Explorer& e) { step_path(e, -1); }, true},
    Command{SDLK_PERIOD, false, "one frame forwards", [](Explorer& e) { step_path(e, 1); }, true},
    Command{SDLK_PAGEUP, false, "one second back", [](Explorer& e) { step_path(e, -30); }, true},
    Command{SDLK_PAGEDOWN, false, "one second forwards", [](Explorer& e) { step_path(e, 30); }, true},
    Command{SDLK_n, false, "go to the next broken promise or missed bar", [](Explorer& e) { e.go_to_broken(); }, true},
    Command{SDLK_k, false, "move the path's camera here", [](Explorer& e) { e.path_editor.put_camera(e.scene); }, true},
    Command{SDLK_q, true, "quit", [](Explorer& e) { e.quit = true; }},
};

}  // namespace

std::span<const Command> commands() { return table; }

std::string key_of(const Command& command)
{
    return fmt::format("{}{}", command.control ? "Ctrl+" : "", SDL_GetKeyName(command.key));
}

bool take_command(Explorer& explorer, const SDL_Event& event)
{
    if (event.type != SDL_KEYDOWN) return false;
    const bool control = (event.key.keysym.mod & KMOD_CTRL) != 0;
    const ImGuiIO& io = ImGui::GetIO();
    for (const Command& command : table) {
        if (command.key != event.key.keysym.sym || command.control != control) continue;
        if (command.typed && (io.WantCaptureKeyboard || io.WantTextInput)) return false;
        // Text fields handle Ctrl+C and Ctrl+V themselves.
        if (command.control && io.WantTextInput) return false;
        const bool steps = command.key == SDLK_COMMA || command.key == SDLK_PERIOD;
        if (event.key.repeat == 0 || steps) command.act(explorer);
        return true;
    }
    return false;
}

}  // namespace mandelmarch::explore
