// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/model.h"

#include <fmt/format.h>

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch::explore {

Model::Model(const Registry& registry_, const Settings& settings_, std::string folder_, const Scene& scene)
    : registry(registry_), folder(std::move(folder_)), settings(settings_), view(scene, settings_.setup)
{
    motion.speed = settings.speed;
    motion.collides = settings.collides;
    listing_.start([&all = registry_] {
        std::vector<Listing> found;
        for (const auto& backend : all.backends()) found.push_back(listing_of(*backend));
        return found;
    });
}

void Model::show(const Scene& scene)
{
    view.set(scene);
    path_editor.playing = false;
    motion.stop();
}

void Model::change(const Scene& scene)
{
    view.remember();
    show(scene);
}

void Model::change(const Setup& setup)
{
    view.remember();
    view.set(setup);
}

Scene Model::official(const Fractal& fractal) const
{
    Scene scene = official_scene(fractal);
    scene.colouring = view.scene().colouring;
    return scene;
}

void Model::choose_look(int look)
{
    view.remember();
    Scene scene = view.scene();
    scene.colouring = settings.look = look;
    view.set(scene);
    say(fmt::format("look: {}", colouring_names.at(static_cast<std::size_t>(look))));
}

void Model::start_from(const StartView& start)
{
    attempt([&] {
        change(parse_parameters(start.text, std::string(start.name), fractal_named(start.fractal)).scene);
        say(fmt::format("{}, {}", start.name, start.fractal));
    });
    const auto number = static_cast<std::size_t>(&start - start_views().data());
    next_start = (number + 1) % start_views().size();
}

void Model::show_path() { show(path_editor.scene(view.scene().width, view.scene().height)); }

void Model::open(const std::string& file)
{
    attempt([&] {
        if (!file.ends_with(".json")) {
            change(read_view(file, *view.scene().fractal));
            return say(file);
        }
        path_editor.open(file);
        view.remember();
        path_editor.go_to(0);
        paths = true;
        show_path();
        say(fmt::format("{}: {} frames", file, path_editor.frames()));
    });
}

void Model::take_news()
{
    listings();
    if (const std::string news = path_editor.take_news(); !news.empty()) say(news);
}

const std::vector<Listing>& Model::listings()
{
    std::string failure;
    if (auto found = listing_.take(failure)) listings_ = std::move(*found);
    return listings_;
}

}  // namespace mandelmarch::explore
