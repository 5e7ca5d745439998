// SPDX-License-Identifier: Apache-2.0
// The functions of Explorer that open, save and export files.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/explore/explorer.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/scene/fractal.h"

namespace mandelmarch::explore {

void Explorer::open(const std::string& file)
{
    guarded([&] {
        if (file.ends_with(".json")) {
            path_editor.open(file);
            remember();
            path_editor.go_to(0);
            paths = true;
            show_path();
            say(fmt::format("{}: {} frames", file, path_editor.frames()));
            return;
        }
        const Scene read = read_view(file, *scene.fractal);
        remember();
        set_scene(read);
        say(file);
    });
}

void Explorer::show_path()
{
    path_editor.playing = false;
    const SDL_Rect place = panes.place(0);
    set_scene(path_editor.scene(place.w, place.h));
}

void Explorer::save_view()
{
    guarded([&] {
        const std::string name = free_name(folder, "view");
        Scene view = scene;
        std::tie(view.width, view.height) = std::pair(panes.place(0).w, panes.place(0).h);
        view.image_file = name.substr(name.rfind('/') + 1) + ".png";
        write_file(name + ".dat", view_text(view));
        say(fmt::format("{}.dat: {}", name, command_of(view, panes.chosen().setup, name + ".dat")));
    });
}

void Explorer::copy_view()
{
    Scene view = scene;
    std::tie(view.width, view.height) = std::pair(panes.place(0).w, panes.place(0).h);
    view.image_file = "view.png";
    if (SDL_SetClipboardText(view_text(view).c_str()) != 0) return say(fmt::format("clipboard: {}", SDL_GetError()));
    say("the view's parameter file is on the clipboard");
}

void Explorer::paste_view()
{
    guarded([&] {
        const std::unique_ptr<char, void (*)(void*)> text(SDL_GetClipboardText(), SDL_free);
        if (text == nullptr || *text == '\0') throw InputError("the clipboard has no text");
        const Scene read = view_of_text(text.get(), "clipboard", *scene.fractal);
        remember();
        set_scene(read);
        say("the clipboard's view");
    });
}

void Explorer::save_picture()
{
    guarded([&] {
        Scene view = scene;
        view.width = picture_width;
        view.height = picture_height;
        picture.start(registry, panes.chosen().setup, view, free_name(folder, "picture"));
        say("drawing a picture");
    });
}

void Explorer::toggle_recording()
{
    if (path_editor.recording()) {
        path_editor.end_recording();
        return say(fmt::format("recorded {} frames", path_editor.frames()));
    }
    path_editor.begin_recording(scene);
    paths = true;
    say("recording: fly");
}

void Explorer::save_path()
{
    guarded([&] {
        const std::string name = free_name(folder, "path") + ".json";
        path_editor.save(name);
        say(fmt::format("{}: bin/flythrough render {} --output film.mp4", name, name));
    });
}

void Explorer::film_path()
{
    guarded([&] {
        path_editor.film(registry, panes.chosen().setup, free_name(folder, "film") + ".mp4", picture_width,
                         picture_height);
        say("filming");
    });
}

void Explorer::go_to_broken()
{
    const auto frame = path_editor.next_broken();
    if (!frame) return say("no broken promise or missed bar has a frame number");
    path_editor.go_to(static_cast<double>(*frame));
    show_path();
    say(fmt::format("frame {}", *frame));
}

std::string Explorer::told() const
{
    using Json = nlohmann::ordered_json;
    Json drawn = Json::array();
    for (const auto& pane : panes.all()) {
        drawn.push_back({{"setup", name_of(pane->setup)},
                         {"view", pane->view},
                         {"samples", pane->samples},
                         {"seconds", pane->seconds},
                         {"failure", pane->failure},
                         {"differing", pane->compared ? Json(pane->compared->differing) : Json()},
                         {"visibly", pane->compared ? Json(pane->compared->visibly_differing) : Json()}});
    }
    int broken = 0;
    for (const Row& row : path_editor.rows()) broken += row.promise && !row.kept() ? 1 : 0;
    const Json json{{"frame", frame_},
                    {"view", view_},
                    {"fractal", scene.fractal->name},
                    {"colouring", scene.colouring},
                    {"eye", {scene.eye.x, scene.eye.y, scene.eye.z}},
                    {"field_of_view", scene.field_of_view},
                    {"clearance", clearance_},
                    {"panes", drawn},
                    {"said", said_},
                    {"path",
                     {{"frames", path_editor.frames()},
                      {"at", path_editor.at()},
                      {"rows", path_editor.rows().size()},
                      {"broken", broken}}}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mandelmarch::explore
