// SPDX-License-Identifier: Apache-2.0
// core/instruments/loops.h computes bounds for the iterations of the kernel's loops. The tests compare these bounds
// with the loops of real rays. They also check the passes into which the schedule divides a picture because of the
// bounds.
#include "core/instruments/loops.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/render/spacing.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "tests/scenes.h"
#include "tests/unit/loops_made.h"

namespace mandelmarch {
namespace {

Loops made_by(const Scene& scene) { return loops_made(scene.fractal->name)(scene); }

std::vector<NamedScene> all_scenes()
{
    std::vector<NamedScene> scenes = odd_scenes();
    for (NamedScene& scene : random_scenes(6, 5)) scenes.push_back(std::move(scene));
    for (NamedScene& named : scenes) {
        named.scene.width = std::min(named.scene.width, 16);
        named.scene.height = 12;
    }
    return scenes;
}

TEST(Loops, NoRayMakesMoreThanTheSchedulesBound)
{
    for (const auto& [name, scene] : all_scenes()) {
        const Loops most = loops_of(scene);
        const Loops made = made_by(scene);
        EXPECT_EQ(made.pass, most.pass) << name;
        EXPECT_LE(made.step, most.step) << name;
        EXPECT_LE(made.tried, most.tried) << name;
        EXPECT_LE(made.refine, most.refine) << name;
        EXPECT_LE(made.shade, most.shade) << name;
    }
}

// Negative control: the official scenes with two iterations reach the bounds exactly, because no orbit near the surface
// escapes earlier. Therefore smaller bounds are wrong.
TEST(Loops, BoundsAreReached)
{
    for (const Fractal& fractal : fractals()) {
        for (const int colouring : {0, 2}) {
            Scene scene = official_scene(fractal, 16, 12);
            scene.iterations = 2;
            scene.colouring = colouring;
            const Loops most = loops_of(scene);
            const Loops made = made_by(scene);
            EXPECT_EQ(made.step, most.step) << fractal.name;
            EXPECT_EQ(made.tried, most.tried) << fractal.name;
            EXPECT_EQ(made.shade, most.shade) << fractal.name << ", colouring " << colouring;
        }
    }
}

// An executor that records the schedule's calls. Its rays march for three passes.
class Noting : public Executor {
public:
    void run(Entry entry, const Band&, int steps) override
    {
        if (entry == Entry::draw) whole = true;
        if (entry == Entry::march) march = std::max(march, steps);
        if (entry == Entry::refine) {
            refine = std::max(refine, steps);
            refined += steps;
        }
    }
    bool marching(const Band&) override { return ++passes < 3; }
    void read_back(const Band&, Image&) override {}

    bool whole = false;
    int march = 0, refine = 0, refined = 0, passes = 0;
};

constexpr std::int64_t survived = 65'000;
Limits limited(const Scene& scene) { return {.pixels_per_band = 64, .loops = LoopLimit{survived, loops_of(scene)}}; }

TEST(Loops, PassesTakeHalfOfTheDevicesLimit)
{
    for (const Fractal& fractal : fractals()) {
        for (const int iterations : {1, 2, 3, 5, 18, 60, 90, 300, 4000}) {
            Scene scene = official_scene(std::string(fractal.short_name), 8, 8);
            scene.iterations = iterations;
            scene.colouring = 0;
            const Loops loops = loops_of(scene);
            Noting noting;
            Image image(8, 8, Image::Layers::bytes);
            run_schedule(scene, Mode::fast, limited(scene), noting, image, {});
            if (noting.whole) {
                EXPECT_LE(loops.pass + max_steps * loops.step + loops.refine + loops.shade, survived / 2);
                continue;
            }
            EXPECT_LE(noting.march * loops.step + loops.pass, survived / 2) << fractal.name << " " << iterations;
            EXPECT_GT((noting.march + 1) * loops.step + loops.pass, survived / 2) << fractal.name << " " << iterations;
            EXPECT_LE(noting.refine * loops.tried + loops.pass, survived / 2) << fractal.name << " " << iterations;
            EXPECT_EQ(noting.refined * loops.tried + loops.pass, loops.refine) << fractal.name << " " << iterations;
        }
    }
}

// Each pass of marching reports progress. The progress distinguishes a device that works on a band of many passes from
// a device that hangs.
TEST(Loops, EveryPassOfMarchingReportsProgress)
{
    Scene scene = official_scene("bulb", 8, 8);
    Noting noting;
    Image image(8, 8, Image::Layers::bytes);
    std::vector<double> signs;
    run_schedule(scene, Mode::exact, limited(scene), noting, image, [&](double share) { signs.push_back(share); });
    EXPECT_EQ(noting.passes, 3);
    EXPECT_EQ(signs, (std::vector<double>{0, 0, 0, 1}));
}

constexpr Starts with_starts{.cones = {{8, 0}, {2, 8}}, .cone_passes = 2, .lattices = {{{0, 2}, {2, 1}}, 2}};

// If a band takes longer than the time limit, the next bands shrink, down to single rows. If it takes less, the next
// bands grow to the largest size that the device holds. Without a time limit, all bands have the largest size, and also
// if rays begin at cones or neighbours: then pixels depend on the rows of their band.
TEST(Loops, BandsAreCutByTime)
{
    const auto bands_of = [](double seconds, const Starts& starts = {}) {
        Noting noting;
        Image image(1024, 200, Image::Layers::bytes);
        std::vector<int> rows;
        int done = 0;
        run_schedule(official_scene("bulb", 1024, 200), Mode::exact,
                     {.pixels_per_band = 1024 * 128,
                      .pixels_to_fill = 1024 * 128,
                      .starts = starts,
                      .seconds_per_band = seconds},
                     noting, image, [&](double share) {
                         rows.push_back(static_cast<int>(std::lround(share * 200)) - done);
                         done += rows.back();
                     });
        return rows;
    };
    std::vector<int> single(185, 1);
    single[0] = 16;
    EXPECT_EQ(bands_of(1e-30), single);
    EXPECT_EQ(bands_of(1e30), (std::vector<int>{16, 64, 120}));
    EXPECT_EQ(bands_of(0), (std::vector<int>{128, 72}));
    EXPECT_EQ(bands_of(1e-30, with_starts), (std::vector<int>{128, 72}));
}

// An executor that records the passes of each band as text, such as "cones 8 in 0".
class Recording : public Executor {
public:
    void run(Entry entry, const Band& band, int) override
    {
        passes.push_back(entry == Entry::cones
                             ? fmt::format("cones {} in {}", band.cones.side, band.cones.within)
                             : fmt::format("pixels {} of {}", band.lattice.apart, band.lattice.before));
    }
    bool marching(const Band&) override { return false; }
    void read_back(const Band& band, Image&) override { passes.push_back(fmt::format("{} rows", band.rows)); }

    std::vector<std::string> passes;
};

TEST(Loops, ConesComeBeforeTheLatticesOfEachBand)
{
    Recording recording;
    Image image(8, 32, Image::Layers::bytes);
    run_schedule(official_scene("bulb", 8, 32), Mode::fast,
                 {.pixels_per_band = 8 * 16, .pixels_to_fill = 8 * 16, .starts = with_starts}, recording, image, {});
    const std::vector<std::string> band{"cones 8 in 0", "cones 2 in 8", "pixels 2 of 0", "pixels 1 of 2", "16 rows"};
    std::vector<std::string> both = band;
    both.insert(both.end(), band.begin(), band.end());
    EXPECT_EQ(recording.passes, both);
}

TEST(Loops, InnerConesBeginAtTheEndsOfTheOuterOnes)
{
    const Scene scene = official_scene("bulb", 640, 640);
    const auto kernel = kernel_scene<layout_f32::Scene>(scene, Mode::fast, {});
    const Starts starts = starts_of(kernel, *scene.fractal, {}, 8, 2, false);
    ASSERT_EQ(starts.cone_passes, 2);
    EXPECT_EQ(starts.cones[0].side, 8);
    EXPECT_EQ(starts.cones[0].within, 0);
    EXPECT_EQ(starts.cones[1].side, 2);
    EXPECT_EQ(starts.cones[1].within, 8);
}

TEST(Loops, ConesTakeHalfOfTheDevicesLimit)
{
    const Loops loops{.pass = 10, .step = 20, .tried = 0, .refine = 0, .shade = 0};
    const std::int64_t needed = 2 * (loops.pass + most_cone_steps * loops.step);
    EXPECT_TRUE(cones_fit({needed, loops}));
    EXPECT_FALSE(cones_fit({needed - 2, loops}));
}

TEST(Loops, TooManyIterationsForAPassAreUnavailable)
{
    Scene scene = official_scene("box", 8, 8);
    scene.iterations = max_iterations;
    Noting noting;
    Image image(8, 8, Image::Layers::bytes);
    scene.colouring = 1;
    EXPECT_NO_THROW(run_schedule(scene, Mode::exact, limited(scene), noting, image, {}));
    scene.colouring = 2;
    EXPECT_THROW(run_schedule(scene, Mode::exact, limited(scene), noting, image, {}), Unavailable);
}

}  // namespace
}  // namespace mandelmarch
