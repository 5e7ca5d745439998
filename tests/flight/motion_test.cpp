// SPDX-License-Identifier: Apache-2.0
// Tests that flights keep their horizon level, and that the longest time during which a camera stands still is found.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "flight/audit/motion.h"
#include "flight/path/path.h"
#include "flight/ride/gaze.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

// Returns a path of 1800 frames that goes once around a fractal. The camera looks ahead, and slightly up and down; its
// up vector leans sideways.
Path round(const std::string& fractal)
{
    Path path;
    path.scene = official_scene(fractal, 16, 9);
    for (int i = 0; i < 1800; ++i) {
        const double angle = 2 * std::numbers::pi * i / 1800;
        const Vector out{std::cos(angle), std::sin(angle), 0};
        const Vector ahead{-std::sin(angle), std::cos(angle), 0.3 * std::sin(5 * angle)};
        path.frames.push_back({9.0 * out, 9.0 * out + ahead, {0, 0.2, 1}, 1, {}});
    }
    return path;
}

double level_share(const Path& path) { return level_row(path).value; }

TEST(Level, IsHeldAwayFromTheMiddle)
{
    Path path = round("bulb");
    EXPECT_LT(level_share(path), 10);
    hold_level(path.frames, *path.scene.fractal);
    EXPECT_GT(level_share(path), 99);
    EXPECT_TRUE(level_row(path).kept());
}

// In a flight around a Mandelbox, the direction upwards is the nearest axis of the cube. The axis stays the same during
// the whole flight, so that the horizon never turns over.
TEST(Level, IsTheNearestAxisOfABox)
{
    Path path = round("box");
    hold_level(path.frames, *path.scene.fractal);
    EXPECT_GT(level_share(path), 99);
    for (const Frame& frame : path.frames) EXPECT_GT(unit(frame.up).z, 0.7);
}

// The camera is level at all times, but its upward direction jumps, and the sky cannot follow.
TEST(Level, IsThatOfTheDrawnHorizon)
{
    Path path = round("box");
    for (std::size_t i = 0; i < path.frames.size(); ++i) {
        path.frames[i].up = i / 100 % 2 == 0 ? Vector{0, 0, 1} : Vector{0, 0, -1};
    }
    EXPECT_LT(level_share(path), 75);
}

TEST(Level, IsTakenSlowly)
{
    Path path = round("bulb");
    // In the second half the camera is upside down.
    for (std::size_t i = 900; i < 1800; ++i) path.frames[i] = rolled(path.frames[i], std::numbers::pi);
    Path turned = path;
    hold_level(turned.frames, *path.scene.fractal);
    const std::vector<double> before = turns_of(path);
    const std::vector<double> after = turns_of(turned);
    EXPECT_GT(before[900], 170);
    for (std::size_t i = 1; i < after.size(); ++i) {
        if (i == 900) continue;
        EXPECT_LT(after[i], before[i] + 0.26) << i;
    }
}

TEST(Level, NeedsNoHorizonStraightUp)
{
    const Frame frame{{0, 0, 2}, {0, 0, 3}, {0, 1, 0}, 1, {}};
    EXPECT_LT(tilt_of(frame, Vector{0, 0, 1}).horizon, 1e-12);
    EXPECT_NEAR(tilt_of(frame, Vector{1, 0, 0}).horizon, 1, 1e-12);
}

Stand plain_search(const std::vector<Vector>& places, const std::vector<double>& radii)
{
    Stand longest;
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::size_t j = i;
        while (j + 1 < places.size() && length(places[j + 1] - places[i]) <= radii[i]) ++j;
        if (j - i > longest.steps) longest = {i, j - i, 0};
    }
    return longest;
}

TEST(Standing, IsWhatAPlainSearchFinds)
{
    std::mt19937 random(5);
    const auto draw = [&](double most) { return most * static_cast<double>(random() % 1000) / 1000; };
    for (int round = 0; round < 300; ++round) {
        std::vector<Vector> places{{0, 0, 0}};
        std::vector<double> radii;
        const double step = draw(0.5);
        while (places.size() < 2 + random() % 200) {
            // At random, the camera stands still, jumps, comes back to an earlier place, or moves on.
            const Vector last = places.back();
            const auto what = random() % 8;
            places.push_back(what == 0   ? places[random() % places.size()]
                             : what == 1 ? last + Vector{draw(3), 0, 0}
                             : what < 5  ? last
                                         : last + Vector{draw(step), draw(step), -draw(step)});
        }
        for (std::size_t i = 0; i < places.size(); ++i) radii.push_back(draw(1));
        const Stand found = longest_stand(places, radii);
        const Stand expected = plain_search(places, radii);
        EXPECT_EQ(found.first, expected.first);
        EXPECT_EQ(found.steps, expected.steps);
    }
}

TEST(Standing, TakesWorkThatGrowsWithTheFrames)
{
    constexpr std::size_t length = 200'000;
    const std::vector<double> radii(length, 1);
    const auto work = [&](auto place) {
        std::vector<Vector> places;
        for (std::size_t i = 0; i < length; ++i) places.push_back(place(i));
        return longest_stand(places, radii).distances;
    };
    // The first camera always stands still, the second stands still but sometimes jumps, the third moves, and the
    // fourth moves slowly.
    EXPECT_LT(work([](std::size_t) { return Vector{1, 2, 3}; }), 4 * length);
    EXPECT_LT(work([](std::size_t i) { return Vector{i % 20'001 == 20'000 ? 2.0 : 0.0, 0, 0}; }), 4 * length);
    EXPECT_LT(work([](std::size_t i) { return Vector{0.3 * static_cast<double>(i), 0, 0}; }), 4 * length);
    EXPECT_LT(work([](std::size_t i) { return Vector{0.00003 * static_cast<double>(i), 0, 0}; }), 4 * length);
}

}  // namespace
}  // namespace mandelmarch
