// SPDX-License-Identifier: Apache-2.0
// openmp renders fast pictures lattice by lattice: the pixels in every fourth column and row, then in every second
// column and row, then all others. This lets rays start near the hits of neighbouring pixels. The picture must be
// nearly the same as if rays did not use their neighbours.
#include <gtest/gtest.h>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/render/registry.h"
#include "core/scene/fractal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

double percent(std::uint64_t count, const Comparison& c)
{
    return 100.0 * static_cast<double>(count) / static_cast<double>(c.pixels);
}

// In films, neighbours share their occlusion. A wall fills the picture up to the top row; the picture before, rendered
// by the same renderer, shows more of it above. Negative control: the pixels do share.
TEST(Neighbours, ShareNothingWithThePictureBefore)
{
    const Registry registry = all_backends();
    const auto scene_of = [](int height) {
        Scene scene = official_scene("bulb", 96, height);
        scene.field_of_view *= 0.02;
        scene.colouring = 2;
        scene.smooth = true;
        return scene;
    };
    const RendererOptions options{.precision = Precision::f32, .mode = Mode::fast};
    const auto renderer = registry.find("openmp")->create(options);
    Image before(96, 128, Image::Layers::all);
    renderer->render(scene_of(128), before);
    Image image(96, 64, Image::Layers::all);
    renderer->render(scene_of(64), image);
    EXPECT_EQ(compare(render(*registry.find("openmp"), scene_of(64), options), image).differing, 0U);
    RendererOptions alone = options;
    alone.techniques.shared_occlusion = false;
    EXPECT_GT(compare(render(*registry.find("openmp"), scene_of(64), alone), image).differing, 50U);
}

// The random scenes are rendered at four times their size. Pixels are then close enough together, in tolerances, for
// rays to use their neighbours.
TEST(Neighbours, ChangeLittleAndSaveEstimates)
{
    const Registry registry = all_backends();
    for (const std::string fractal : {"bulb", "box"}) {
        Comparison all;
        Work with;
        Work without;
        for (const NamedScene& named : random_scenes(20, 606)) {
            if (named.scene.fractal->short_name != fractal) continue;
            Scene scene = named.scene;
            scene.width *= 4;
            scene.height *= 4;
            const auto drawn = [&](bool neighbours, Work& work) {
                const RendererOptions options{.mode = Mode::fast, .techniques = {.neighbours = neighbours}};
                Image image(scene.width, scene.height, Image::Layers::all);
                work.de_calls += registry.find("openmp")->create(options)->render(scene, image).work.de_calls;
                return image;
            };
            const Comparison one = compare(drawn(true, with), drawn(false, without));
            all.pixels += one.pixels;
            all.visibly_differing += one.visibly_differing;
            all.hit_or_miss += one.hit_or_miss;
        }
        EXPECT_LE(percent(all.visibly_differing, all), 1) << fractal;
        EXPECT_LE(percent(all.hit_or_miss, all), 0.01) << fractal;
        EXPECT_LT(with.de_calls, without.de_calls * 9 / 10) << fractal;
        EXPECT_GT(all.visibly_differing, 0U) << fractal;  // shows that rays did use their neighbours
    }
}

}  // namespace
}  // namespace mandelmarch
