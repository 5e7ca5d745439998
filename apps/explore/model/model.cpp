// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/model.h"

#include <fmt/format.h>

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
    for (const std::string& news : {path_editor.take_news(), picture.take_news()}) {
        if (!news.empty()) say(news);
    }
}

const std::vector<Listing>& Model::listings()
{
    std::string failure;
    if (auto found = listing_.take(failure)) listings_ = std::move(*found);
    return listings_;
}

}  // namespace mandelmarch::explore
