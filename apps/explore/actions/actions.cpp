// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/actions/actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "core/os/output_file.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/text/error.h"

namespace mandelmarch::explore {
namespace {

void use(Model& model, const Setup& setup)
{
    model.change(setup);
    model.say(name_of(setup));
}

// Selects the next device of the backend or, after its last device, the next backend that draws the scene. As soon as
// all devices have been listed, backends without devices are skipped.
void next_backend(Model& model)
{
    const auto& backends = model.registry.backends();
    const auto& listings = model.listings();
    const Setup& setup = model.view.setup();
    std::size_t at = 0;
    while (at + 1 < backends.size() && backends[at]->name() != setup.backend) ++at;
    if (!listings.empty() && setup.device + 1 < static_cast<int>(listings[at].devices.size())) {
        return use(model, {setup.backend, setup.device + 1, setup.precision, setup.mode});
    }
    for (std::size_t tried = 0; tried < backends.size(); ++tried) {
        at = (at + 1) % backends.size();
        if (backends[at]->draws(model.view.scene()) && (listings.empty() || !listings[at].devices.empty())) break;
    }
    use(model, with_device(setup, *backends[at], 0));
}

void next_fractal(Model& model)
{
    const auto all = fractals();
    const auto at = static_cast<std::size_t>(model.view.scene().fractal - all.data());
    const Fractal& next = all[(at + 1) % all.size()];
    model.change(model.official(next));
    model.say(std::string(next.name));
}

void next_colouring(Model& model) { model.choose_look((model.view.scene().colouring + 1) % colouring_types); }

void next_view(Model& model)
{
    if (start_views().empty()) throw Error("this build has no views to start from");
    model.start_from(start_views()[model.next_start]);
}

// Adds a pane with another precision or mode. If there are four panes already, only the first one stays.
void more_panes(Model& model)
{
    ShownView& view = model.view;
    view.remember();
    const std::size_t count = view.setups().size() % most_panes + 1;
    view.set_count(count);
    view.choose(count - 1);
    if (count == 1) return;
    Setup setup = view.setups().front();
    if (count == 2 || count == 4) setup = with_other_precision(setup);
    if (count >= 3) setup = with_other_mode(setup);
    view.set(setup);
}

void toggle_walls(Model& model)
{
    model.motion.collides = !model.motion.collides;
    model.say(model.motion.collides ? "walls stop the flight" : "the flight goes through walls");
}

void save_view(Model& model)
{
    const std::string name = free_name(model.folder, "view");
    Scene scene = model.view.scene();
    scene.image_file = name.substr(name.rfind('/') + 1) + ".png";
    write_file(name + ".dat", view_text(scene));
    model.say(fmt::format("{}.dat: {}", name, command_of(scene, model.view.setup(), name + ".dat")));
}

void save_place(Model& model)
{
    const Scene& scene = model.view.scene();
    const std::string name =
        fmt::format("{}{}{}-places.csv", model.folder, model.folder.empty() ? "" : "/", scene.fractal->name);
    const std::size_t count = append_place(name, scene);
    const Scene official = official_scene(*scene.fractal);
    const bool official_shape = std::tie(scene.shape, scene.escape, scene.iterations) ==
                                std::tie(official.shape, official.escape, official.iterations);
    model.say(fmt::format("place {} in {}: bin/flythrough film --fractal {}{} --places {}", count, name,
                          scene.fractal->name, official_shape ? "" : " --params VIEW.dat (saved with Ctrl+S)", name));
}

void record(Model& model)
{
    if (model.path_editor.recording()) {
        model.path_editor.end_recording();
        return model.say(fmt::format("recorded {} frames", model.path_editor.frames()));
    }
    model.path_editor.begin_recording(model.view.scene());
    model.paths = true;
    model.say("recording: fly");
}

void save_path(Model& model)
{
    const std::string name = free_name(model.folder, "path") + ".json";
    model.path_editor.save(name);
    model.say(fmt::format("{}: bin/flythrough render {} --output film.mp4", name, name));
}

void film_path(Model& model)
{
    model.path_editor.film(model.registry, model.view.setup(), free_name(model.folder, "film") + ".mp4",
                           model.film_width, model.film_height);
    model.say("filming");
}

void plan_tour(Model& model)
{
    model.path_editor.plan(model.view.scene(), static_cast<std::uint64_t>(model.tour_seed), model.tour_frames);
    model.paths = true;
    model.say("planning a tour");
}

void need_path(const Model& model)
{
    if (!model.path_editor.has_path()) throw Error("there is no path: Ctrl+R records one");
}

void play(Model& model)
{
    need_path(model);
    PathEditor& path_editor = model.path_editor;
    if (path_editor.recording()) record(model);
    path_editor.playing = !path_editor.playing;
    if (path_editor.playing && path_editor.at() + 1 >= static_cast<double>(path_editor.frames())) path_editor.go_to(0);
}

template <int frames>
void step(Model& model)
{
    need_path(model);
    model.path_editor.go_to(model.path_editor.at() + frames);
    model.show_path();
}

void after_undo(Model& model, bool done, const char* name)
{
    if (!done) throw Error(fmt::format("there is nothing to {}", name));
    model.motion.stop();
}

constexpr auto over_pictures = Action::Heeded::over_pictures;
constexpr auto repeated = Action::Heeded::repeated;

constexpr std::array table{
    Action{"help", "F1", "show or hide this help", [](Model& m) { m.help = !m.help; }},
    Action{"panel", "F2", "show or hide the panel", [](Model& m) { m.settings.panel = !m.settings.panel; }},
    Action{"focus", "Escape", "go to the panel or back; arrow keys and Enter work there",
           [](Model& m) { m.changes_focus = true; }},
    Action{"statistics", "F3", "show or hide statistics",
           [](Model& m) { m.settings.statistics = !m.settings.statistics; }},
    Action{"next-backend", "F4", "next backend or device", next_backend},
    Action{"next-precision", "F5", "switch between float and double",
           [](Model& m) { use(m, with_other_precision(m.view.setup())); }},
    Action{"next-mode", "F6", "switch between exact and fast",
           [](Model& m) { use(m, with_other_mode(m.view.setup())); }},
    Action{"next-fractal", "F7", "next fractal", next_fractal},
    Action{"next-colouring", "F8", "next look (colouring type)", next_colouring},
    Action{"next-view", "V", "next view to start from", next_view, over_pictures},
    Action{"more-panes", "F9", "add a picture at the side, up to four; then go back to one", more_panes},
    Action{"next-pane", "F10", "next pane", [](Model& m) { m.view.choose(m.view.chosen() + 1); }},
    Action{"marks", "M", "turn the marks of differing pixels on or off",
           [](Model& m) {
               m.marks = !m.marks;
               m.view.changed();
           },
           over_pictures},
    Action{"full-screen", "F11", "turn full screen on or off", [](Model& m) { m.changes_full_screen = true; }},
    Action{"reset-view", "Home", "reset the view to the official scene; the look stays",
           [](Model& m) { m.change(m.official(*m.view.scene().fractal)); }, over_pictures},
    Action{"walls", "C", "switch between flying through walls and stopping at them", toggle_walls, over_pictures},
    Action{"undo", "Ctrl+Z", "undo", [](Model& m) { after_undo(m, m.view.undo(), "undo"); }},
    Action{"redo", "Ctrl+Y", "redo", [](Model& m) { after_undo(m, m.view.redo(), "redo"); }},
    Action{"save-view", "Ctrl+S", "save the view as a parameter file for bin/render", save_view},
    Action{"save-place", "Ctrl+N", "add the view to the places that a film visits", save_place},
    Action{"record", "Ctrl+R", "record a path, or end the recording", record},
    Action{"smooth", "Ctrl+L", "smooth the path", [](Model& m) { m.path_editor.smooth(); }},
    Action{"save-path", "Ctrl+D", "save the path", save_path},
    Action{"film", "Ctrl+M", "render a film of the path", film_path},
    Action{"plan-a-tour", "Ctrl+T", "plan a tour from the seed", plan_tour},
    Action{"paths", "F12", "show or hide the paths panel", [](Model& m) { m.paths = !m.paths; }},
    Action{"play-or-stop", "Space", "play the path, or stop", play, over_pictures},
    Action{"frame-back", ",", "one frame back", step<-1>, repeated},
    Action{"frame-forwards", ".", "one frame forwards", step<1>, repeated},
    Action{"second-back", "PageUp", "one second back", step<-30>, over_pictures},
    Action{"second-forwards", "PageDown", "one second forwards", step<30>, over_pictures},
    Action{"quit", "Ctrl+Q", "quit", [](Model& m) { m.quit = true; }},
};

}  // namespace

void Action::perform(Model& model) const
{
    model.attempt([&] { act(model); });
}

std::span<const Action> actions() { return table; }

const Action* action_named(std::string_view name)
{
    const auto* found = std::ranges::find(table, name, &Action::name);
    return found != table.end() ? found : nullptr;
}

}  // namespace mandelmarch::explore
