// SPDX-License-Identifier: Apache-2.0
// Two configurations have the same expected picture only if their scenes, modes and precisions are equal.
#include "bench/measure/verify.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "backends/all.h"
#include "core/scene/fractal.h"
#include "tests/scenes.h"

namespace mandelmarch::bench {
namespace {

TEST(ExpectedPictures, DifferForScenesThatLookDifferent)
{
    const Registry registry = all_backends();
    const ExpectedPictures pictures(registry);
    Case one;
    one.scene = official_scene("box", 20, 10);
    EXPECT_TRUE(pictures.same(one, Case(one)));
    const std::vector<std::function<void(Case&)>> changes{
        [](Case& c) { c.scene.eye.z += 1; },
        [](Case& c) { c.scene.projection = Projection::equirectangular; },
        [](Case& c) { c.scene.fractal = &fractal_named("bulb"); },
        [](Case& c) { c.options.mode = Mode::fast; },
        [](Case& c) { c.options.precision = Precision::f32; },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Case other = one;
        changes[i](other);
        EXPECT_FALSE(pictures.same(one, other)) << "change " << i;
    }
}

}  // namespace
}  // namespace mandelmarch::bench
