// SPDX-License-Identifier: Apache-2.0
// Two configurations have the same expected picture only if their scenes are equal.
#include "bench/harness/verify.h"

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
    // Members of the scene itself, of records in it, and those that no parameter file has.
    const std::vector<std::function<void(Scene&)>> changes{
        [](Scene& s) { s.eye.z += 1; },
        [](Scene& s) { s.shape[1] = 0.25; },
        [](Scene& s) { s.conservative = true; },
        [](Scene& s) { s.crop_window.left = 1; },
        [](Scene& s) { s.limits.step_factor = 0.5; },
        [](Scene& s) { s.projection = Projection::equirectangular; },
        [](Scene& s) { s.sun.y = 2; },
        [](Scene& s) { s.fractal = &fractal_named("bulb"); },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Case other = one;
        changes[i](other.scene);
        EXPECT_FALSE(pictures.same(one, other)) << "change " << i;
    }
}

}  // namespace
}  // namespace mandelmarch::bench
