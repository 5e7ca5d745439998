// SPDX-License-Identifier: Apache-2.0
// Techniques that save work: hulls change no bit of exact pictures (docs/hulls.md has the proofs), tails change nearly
// no estimate, and rays that start near the hits of neighbouring pixels change few pixels.
#include <gtest/gtest.h>

#include <cmath>

#include "backends/all.h"
#include "core/image/compare.h"
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

// Tails are the last iterations of an orbit of the Mandelbox, computed with only one escape test and no sphere folds.
box64::Scene with_tails(const Scene& scene, bool tails)
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
    const box64::Scene without = with_tails(scene, false);
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
        const box64::Scene with = with_tails(scene, true);
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

// Negative control: if the radius at which tails begin is wrong, they begin too near to the spheres or too far out.
TEST(Tails, WrongRadiiChangeEstimates)
{
    const Scene scene = official_scene("box", 270, 270);
    for (const double factor : {0.5, 2.0}) {
        box64::Scene with = with_tails(scene, true);
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

// openmp renders fast pictures lattice by lattice: the pixels in every fourth column and row, then in every second
// column and row, then all others.
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
