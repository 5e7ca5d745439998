// SPDX-License-Identifier: Apache-2.0
// Tails are the last iterations of an orbit of the Mandelbox, computed with only one escape test and no sphere folds.
// Nearly all estimates must be the same as without tails.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/fractal.h"
#include "tests/scenes.h"
#include "tests/unit/kernels.h"

namespace mandelmarch {
namespace {

box64::Scene scene_of(const Scene& scene, bool tails)
{
    return scene_for_kernel<box64::Scene>(scene, Mode::fast, {.tail = tails});
}

struct Difference {
    int samples = 0;
    int iterations = 0;  // samples for which the numbers of iterations differ
    int distances = 0;   // samples for which the estimates differ by a fraction of more than 10^-9
};

// Compares the estimates with and without tails, at all samples of the rays in every eighth column and row.
Difference difference(const Scene& scene, const box64::Scene& with)
{
    const box64::Scene without = scene_of(scene, false);
    Difference found;
    for (int y = 0; y < scene.height; y += 8) {
        for (int x = 0; x < scene.width; x += 8) {
            box64::Ray ray = box64::begin(without, x, y);
            while (box64::marching(without, ray)) {
                const box64::vec3 p = box64::point_at(without, ray, ray.t);
                const box64::Estimate a = box64::estimate(without, p, true);
                const box64::Estimate b = box64::estimate(with, p, true);
                ++found.samples;
                found.iterations += a.iterations != b.iterations;
                found.distances += !(std::abs(a.distance - b.distance) <= 1e-9 * std::abs(a.distance));
                ray = box64::advance(without, ray, true);
            }
        }
    }
    return found;
}

TEST(Tails, LeaveEstimatesAsTheyAre)
{
    Difference all;
    for (const auto& [name, scene] : random_scenes(24, 2002)) {
        if (scene.fractal->short_name != "box") continue;
        const box64::Scene with = scene_of(scene, true);
        if (box64::box_tail_end(with) == 0) continue;
        const Difference found = difference(scene, with);
        EXPECT_LE(found.distances, found.samples / 30) << name;
        EXPECT_LE(found.iterations, found.samples / 30) << name;
        all.samples += found.samples;
        all.distances += found.distances;
    }
    EXPECT_GT(all.samples, 10'000);
    EXPECT_LE(all.distances, all.samples / 250);
}

TEST(Tails, HitTheOfficialSceneInNearlyEverySample)
{
    const Scene scene = official_scene("box", 270, 270);
    const Difference found = difference(scene, scene_of(scene, true));
    EXPECT_GT(found.samples, 1000);
    EXPECT_LE(found.distances, found.samples / 200);
}

// Negative control: if the radius at which tails begin is wrong, they begin too near to the spheres or too far out.
TEST(Tails, WrongRadiiChangeEstimates)
{
    const Scene scene = official_scene("box", 270, 270);
    for (const double factor : {0.5, 2.0}) {
        box64::Scene with = scene_of(scene, true);
        with.fractal[7] *= factor * factor;
        const Difference found = difference(scene, with);
        EXPECT_GT(found.distances, found.samples / 4) << factor;
    }
}

TEST(Tails, AreForFastModeOnly)
{
    const Scene scene = official_scene("box", 270, 270);
    EXPECT_EQ(kernel_scene<layout_f64::Scene>(scene, Mode::exact).fractal_whole, 0);
    EXPECT_EQ(kernel_scene<layout_f32::Scene>(scene, Mode::exact).fractal_whole, 0);
    EXPECT_GT(kernel_scene<layout_f32::Scene>(scene, Mode::fast).fractal_whole, 0);
    Scene near = scene;
    near.escape = 10;  // too small for a tail of three iterations
    EXPECT_EQ(kernel_scene<layout_f64::Scene>(near, Mode::fast).fractal_whole, 0);
}

}  // namespace
}  // namespace mandelmarch
