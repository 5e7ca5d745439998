// SPDX-License-Identifier: Apache-2.0
// Hulls save work and do not change a bit of exact pictures. docs/hulls.md has the proofs.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/fractal.h"
#include "core/scene/hull.h"
#include "tests/scenes.h"
#include "tests/unit/kernels.h"

namespace mandelmarch {
namespace {

double size_of(const Scene& scene) { return hull_size(scene, std::pow(10.0, scene.detail)); }

// Returns the number of pixels that change if the hull's size is multiplied by `share`.
template <class KernelScene, class Draw>
int changed(const Scene& scene, double share, Draw draw)
{
    const auto k = scene_for_kernel<KernelScene>(scene);
    KernelScene smaller = k;
    smaller.hull *= share;
    int count = 0;
    for (int j = 0; j < k.height; ++j) {
        for (int i = 0; i < k.width; ++i) count += draw(k, i, j) != draw(smaller, i, j);
    }
    return count;
}

TEST(Hull, TooSmallChangesPictures)
{
    const auto box_depth = [](const box64::Scene& k, int i, int j) { return box64::draw(k, i, j).depth; };
    const auto bulb_depth = [](const bulb64::Scene& k, int i, int j) { return bulb64::draw(k, i, j).depth; };
    const Scene box_scene = official_scene("box", 100, 100);
    const Scene bulb_scene = official_scene("bulb", 100, 100);
    EXPECT_EQ(changed<box64::Scene>(box_scene, 1, box_depth), 0);
    EXPECT_GT(changed<box64::Scene>(box_scene, 0.9, box_depth), 0);
    EXPECT_EQ(changed<bulb64::Scene>(bulb_scene, 1, bulb_depth), 0);
    EXPECT_GT(changed<bulb64::Scene>(bulb_scene, 0.9, bulb_depth), 0);
}

TEST(Hull, IsLittleLargerThanTheSet)
{
    const double box = size_of(official_scene("box", 10, 10));  // size of the Mandelbox: 2 (s + 1) / (s - 1) = 6
    EXPECT_GT(box, 6);
    EXPECT_LT(box, 6.02);
    const double bulb = size_of(official_scene("bulb", 10, 10));  // radius of the Mandelbulb: at most 2^(1/7) = 1.104
    EXPECT_GT(bulb, 1.104);
    EXPECT_LT(bulb, 1.11);
}

TEST(Hull, IsAbsentWhereNothingIsProven)
{
    Scene scene = official_scene("box", 10, 10);
    scene.shape[0] = 0.9;
    EXPECT_EQ(size_of(scene), 0);
    scene.shape[0] = -1;
    EXPECT_EQ(size_of(scene), 0);
    scene.shape = {2, 1.5, 1};
    EXPECT_EQ(size_of(scene), 0);
    scene = official_scene("box", 10, 10);
    scene.detail = -0.5;
    EXPECT_EQ(size_of(scene), 0);
    scene = official_scene("bulb", 10, 10);
    scene.shape[2] = 1;
    EXPECT_EQ(size_of(scene), 0);
    scene.shape[2] = 8;
    scene.shape[1] = 1e5;  // an escape radius that no orbit reaches in one iteration
    scene.iterations = 1;
    EXPECT_EQ(size_of(scene), 0);
}

// Checks the bounds on which the hull's proof is based. At points on the hull, the estimate in double must exceed the
// tolerance.
TEST(Hull, NoPointOutsideIsASurface)
{
    const Scene scene = official_scene("box", 10, 10);
    const auto k = scene_for_kernel<box64::Scene>(scene);
    const double size = size_of(scene);
    for (int i = 0; i < 100'000; ++i) {
        // The points cover a whole face of the cube evenly.
        const double u = -1 + 2 * std::fmod(i * 0.618033988749895, 1);
        const double v = -1 + 2 * std::fmod(i * 0.754877666246693, 1);
        const box64::vec3 p{size, u * size, v * size};
        const double t = std::sqrt(3.0) * size + 19;  // not less than the point's distance from the camera
        EXPECT_GT(box64::estimate(k, p, true).distance, k.tolerance * t) << p.y << " " << p.z;
    }
}

}  // namespace
}  // namespace mandelmarch
