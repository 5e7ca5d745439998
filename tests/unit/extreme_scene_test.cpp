// SPDX-License-Identifier: Apache-2.0
// Extreme scenes are reproducible, valid as parameter files, and varied. At least a third of them show a surface.
#include "core/scene/random_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "backends/all.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

TEST(ExtremeScene, IsTheSameForTheSameNumbersOnly)
{
    std::set<std::string> texts;
    for (const Fractal& fractal : fractals()) {
        for (const unsigned seed : {1U, 2U}) {
            for (int number = 0; number < 20; ++number) {
                const std::string text = to_parameters(extreme_scene(fractal, seed, number));
                EXPECT_EQ(text, to_parameters(extreme_scene(fractal, seed, number)));
                texts.insert(text);
            }
        }
    }
    EXPECT_EQ(texts.size(), fractals().size() * 2 * 20);
}

TEST(ExtremeScene, GoesFarAndShowsSomething)
{
    const auto openmp = make_openmp_backend()->create({});
    for (const Fractal& fractal : fractals()) {
        std::set<int> colourings;
        int few = max_iterations;
        int many = 0;
        double finest = 0;
        int seen = 0;
        int long_rays = 0;
        constexpr int scenes = 120;
        for (int number = 0; number < scenes; ++number) {
            Scene scene = extreme_scene(fractal, 1, number);
            colourings.insert(scene.colouring);
            few = std::min(few, scene.iterations);
            many = std::max(many, scene.iterations);
            finest = std::min(finest, scene.detail);
            if (scene.iterations > 100) continue;
            scene.width = 8;
            scene.height = 6;
            Image image(8, 6, Image::Layers::all);
            openmp->render(scene, image);
            const auto is_hit = [](const PixelValue& value) { return value.depth < 1e30; };
            seen += std::ranges::any_of(image.values(), is_hit);
            long_rays += std::ranges::any_of(image.values(), [](const PixelValue& value) { return value.steps > 500; });
        }
        EXPECT_EQ(colourings.size(), std::size_t{colouring_types}) << fractal.name;
        EXPECT_LE(few, 2) << fractal.name;
        EXPECT_GE(many, 5000) << fractal.name;
        EXPECT_LE(finest, -9) << fractal.name;
        EXPECT_GE(seen, scenes / 3) << fractal.name;
        EXPECT_GE(long_rays, 1) << fractal.name;
    }
}

}  // namespace
}  // namespace mandelmarch
