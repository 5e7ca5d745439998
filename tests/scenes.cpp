// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes.h"

#include <fmt/format.h>

#include <random>

#include "core/render/agreement.h"
#include "core/scene/fractal.h"
#include "core/scene/random_scene.h"

namespace mandelmarch {

Scene official_scene(const std::string& short_name, int width, int height)
{
    return mandelmarch::official_scene(fractal_named(short_name), width, height);
}

namespace {

class Scenes {
public:
    Scene& add(std::string name, const Scene& scene)
    {
        return scenes_.emplace_back(NamedScene{std::move(name), scene}).scene;
    }

    void add_bulbs(const Scene& bulb)
    {
        add("bulb, power 2", bulb).shape[2] = 2;
        add("bulb, power 9", bulb).shape[2] = 9;
        add("bulb, power 7.5", bulb).shape[2] = 7.5;
        add("bulb, power 1", bulb).shape[2] = 1;
        add("bulb, colouring 0", bulb).colouring = 0;
        add("bulb, few iterations", bulb).iterations = 1;
        add("bulb, camera inside", bulb).eye = {0.1, 0.2, 0.1};
        add("bulb, on the axis", bulb).eye = {0, 0, 2.5};
        scenes_.back().scene.up = {1, 0, 0};
        add("bulb, up along z", bulb).up = {0, 0, 1};
        add("bulb, conservative", bulb).conservative = true;
        add("bulb, conservative, power 7.5", bulb).shape[2] = 7.5;
        scenes_.back().scene.conservative = true;
        add_film("bulb, a part of a film", bulb);
    }

    void add_boxes(const Scene& box)
    {
        add("box, scale -1.5", box).shape[0] = -1.5;
        add("box, scale 3", box).shape[0] = 3;
        add("box, other radii", box).shape = {2, 0.25, 1.5};
        add("box, oblique up", box).up = {0.3, -1, 0.7};
        add("box, camera inside", box).eye = {0.5, 0.5, 0.5};
        add("box, four iterations", box).iterations = 4;
        add("box, one column", box).width = 1;
        add_film("box, a part of a film", box);
    }

    void add_julias(const Scene& julia)
    {
        add("julia", julia);
        add("julia, c = 0", julia).shape = {0, 0, 0};
        scenes_.back().scene.escape = 0;
        add("julia, camera inside", julia).eye = {0.05, 0.02, 0.03};
        add("julia, hundreds of iterations", julia).iterations = 300;
    }

    // Adds a scene with the options that films use. Its picture is a crop window of a picture of 1920 x 1080 pixels.
    void add_film(std::string name, const Scene& of)
    {
        Scene& scene = add(std::move(name), of);
        scene.conservative = scene.smooth = scene.centred = true;
        scene.crop_window = {.left = 900, .bottom = 500, .whole_width = 1920, .whole_height = 1080};
    }

    std::vector<NamedScene> take() { return std::move(scenes_); }

private:
    std::vector<NamedScene> scenes_;
};

}  // namespace

LookValues cloudy_look()
{
    return parse_look(R"(surface 0.5 0.4 0.3
                         layer_1 0.8 0.6 0.4  0.5 0.3 0.2  0.1 0.5
                         layer_2 0.1 0.4 0.5  0.3 0.5 0.1  0.1 0.5
                         layer_3 0.2 0.1 0.6  0.2 0.2 0.3  0.1 0.5
                         layer_4 0.6 0.2 0.1  0.1 0.1 0.5  0.1 0.5
                         sun 2.0 1.6 1.1
                         sky_light 0.3 0.4 0.6
                         ground_light 0.3 0.2 0.1
                         camera_light 0.2 0.2 0.2
                         lamp 0.5 0.4 0.3
                         fill_light 0.1 0.1 0.2
                         zenith 0.1 0.2 0.5
                         horizon 0.4 0.5 0.6
                         glow 0.8 0.6 0.4
                         halo 0.3 0.6
                         horizon_glow 0.4
                         clouds 0.6
                         haze 0.3
                         exposure 0.8)",
                      "cloudy");
}

std::vector<NamedScene> odd_scenes()
{
    Scenes scenes;
    for (const Fractal& fractal : fractals()) {
        const Scene scene = official_scene(fractal, 47, 33);
        if (fractal.short_name == "bulb") scenes.add_bulbs(scene);
        if (fractal.short_name == "box") scenes.add_boxes(scene);
        if (fractal.short_name == "julia") scenes.add_julias(scene);
    }
    // Adds the looks that the original programs do not have, for every fractal.
    for (int look = 2; look < colouring_types; ++look) {
        for (const Fractal& fractal : fractals()) {
            const std::string name = fmt::format("{}, look {}", fractal.short_name, look);
            scenes.add(name, official_scene(fractal, 47, 33)).colouring = look;
        }
    }
    for (const Fractal& fractal : fractals()) {
        Scene scene = official_scene(fractal, 47, 33);
        scene.sky = {.up = {0.36, 0.8, 0.48}, .north = {0.8, 0, -0.6}, .sun = {-0.6, 0.8, 0}};
        scenes.add(fmt::format("{}, another sky", fractal.short_name), scene).colouring = 2;
        scene.projection = Projection::equirectangular;
        scenes.add(fmt::format("{}, all directions", fractal.short_name), scene);
        scene.centred = true;
        scene.crop_window = {.left = 40, .bottom = 20, .whole_width = 160, .whole_height = 80};
        scenes.add(fmt::format("{}, some of all directions", fractal.short_name), scene);
        scene.crop_window = {};
        scene.look = cloudy_look();
        scene.grainy = true;
        scenes.add(fmt::format("{}, a look of its own", fractal.short_name), scene);
    }
    return scenes.take();
}

std::vector<NamedScene> random_scenes(int per_fractal, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<NamedScene> scenes;
    for (const Fractal& fractal : fractals()) {
        const Scene like = official_scene(fractal, 61, 45);
        for (int i = 0; i < per_fractal; ++i) {
            scenes.push_back({fmt::format("{}, random {}", fractal.short_name, i), random_scene(like, i, random)});
        }
    }
    return scenes;
}

std::string trace_command(const Scene& scene, const RendererOptions& options, std::int64_t pixel)
{
    return fmt::format("{} --pixel {},{} --trace", render_command(scene, options), pixel % scene.width,
                       pixel / scene.width);
}

Image render(const Backend& backend, const Scene& scene, const RendererOptions& options)
{
    Image image(scene.width, scene.height, Image::Layers::all);
    backend.create(options)->render(scene, image);
    return image;
}

}  // namespace mandelmarch
