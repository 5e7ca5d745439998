// SPDX-License-Identifier: Apache-2.0
// Tests the director, which chooses the gaze over time from panoramas, and the speed of the flight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flight/audit/views.h"
#include "flight/ride/director.h"
#include "flight/ride/gaze.h"
#include "flight/ride/pacing.h"
#include "flight/ride/trajectory.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

constexpr int frames = 300;

// A path that passes the fractal from its left to its right, 0.3 above it.
struct Passing {
    Shapes shapes{official_scene("bulb", 16, 9), 2, 0};
    const DistanceField& field = shapes.field();
    Curve track;
    Trajectory flown;

    Passing()
    {
        ControlPoints line;
        for (int i = 0; i < 60; ++i) line.at.push_back({-2 + 4.0 * i / 59, 0.2, 1.5});
        line.clock.assign(60, 0);
        track = track_of(shapes, {}, line);
        flown = ride(field.bounds(), track, 0.05, frames + look_ahead);
    }

    double mean_hit_share(const std::vector<Vector>& gaze) const
    {
        double sum = 0;
        int count = 0;
        const std::vector<Frame> shots = cameras(flown, gaze, {0, 1, 0}, 1.0);
        for (std::size_t i = 0; i < shots.size(); i += 10, ++count) sum += view_of(field, shots[i]).hit_share();
        return sum / count;
    }
};

TEST(Sphere, DirectionsAreSpreadEvenly)
{
    const Sphere sphere(500, 0.3);
    Vector sum{};
    for (const Vector& direction : sphere.directions()) {
        EXPECT_NEAR(length(direction), 1, 1e-12);
        sum = sum + direction;
    }
    EXPECT_LT(length(sum), 1);
    // The part of a sphere within an angle of 0.3 radians of a direction is (1 - cos 0.3) / 2 of the sphere.
    const double expected = 500 * (1 - std::cos(0.3)) / 2;
    for (int d = 0; d < 500; ++d) {
        EXPECT_EQ(sphere.near(d).front(), d);
        EXPECT_NEAR(static_cast<double>(sphere.near(d).size()), expected, 0.45 * expected) << d;
        EXPECT_EQ(sphere.nearest(sphere.directions()[static_cast<std::size_t>(d)]), d);
    }
}

TEST(Panorama, SeesTheFractalWhereItIs)
{
    const Shapes shapes(official_scene("bulb", 16, 9), 2, 0);
    const Sphere sphere(200, 0.3);
    const std::vector<Vector> places{{0, 0, 4}, {4, 0, 0}};
    const auto depths = panoramas(shapes, sphere, places, std::vector<double>(2, shapes.usual()), 20);
    const auto depth = [&](std::size_t place, Vector direction) {
        return depths[place * 200 + static_cast<std::size_t>(sphere.nearest(direction))];
    };
    EXPECT_NEAR(depth(0, {0, 0, -1}), 3, 0.4);
    EXPECT_TRUE(std::isinf(depth(0, {0, 0, 1})));
    EXPECT_NEAR(depth(1, {-1, 0, 0}), 3, 0.4);
    EXPECT_TRUE(std::isinf(depth(1, {0, 0, -1})));
}

// The camera is close to an outer face of the Mandelbox and looks past it. Many rays need over 100 steps to leave.
TEST(Panorama, SkyBesideAFaceOfTheBoxIsEmpty)
{
    const Shapes shapes(official_scene("box", 16, 9), 2, 0);
    const Frame frame{{5.757, 6.010, 0.843}, {5.851, 6.541, 0.001}, {-0.096, -0.837, -0.539}, 1, {}};
    EXPECT_LT(view_of(shapes.field(), frame).hit_share(), 0.1);
    const Sphere sphere(1000, 0.4);
    const std::vector<Vector> places{frame.eye};
    const auto depths = panoramas(shapes, sphere, places, std::vector<double>(1, shapes.usual()), 100);
    for (const int direction : sphere.near(sphere.nearest(unit(frame.target - frame.eye)))) {
        EXPECT_TRUE(std::isinf(depths[static_cast<std::size_t>(direction)])) << direction;
    }
}

// Negative control: a camera that always looks ahead, past the fractal, shows less of the fractal.
TEST(Director, ShowsMoreThanLookingAhead)
{
    const Passing way;
    ASSERT_GE(way.flown.at.size(), static_cast<std::size_t>(frames));
    std::vector<Vector> straight;
    for (std::size_t i = 0; i < frames; ++i) straight.push_back(ahead(way.flown, i, look_ahead));
    const Director director(way.shapes, way.track);
    const double directed = way.mean_hit_share(smoothed_gaze(way.flown, director.gaze(way.flown, frames)));
    EXPECT_GT(directed, way.mean_hit_share(straight) + 0.15);
}

TEST(Director, EstimatesHowFarThePictureMoves)
{
    const Passing way;
    const Director director(way.shapes, way.track);
    const auto shots = cameras(way.flown, smoothed_gaze(way.flown, director.gaze(way.flown, frames)), {0, 1, 0}, 1.0);
    for (std::size_t v = 1; v < 5; ++v) {
        const std::size_t i = 50 * v;
        const double seen = median_motion(view_of(way.field, shots[i]), shots[i], shots[i + 1]);
        EXPECT_NEAR(director.motion(way.flown.sample[i], shots[i], shots[i + 1]), seen, 0.4 * seen) << i;
    }
}

// The camera is slow near a wall, and its acceleration does not jump. Negative control: if the speed jumps, the limit
// is exceeded.
TEST(Trajectory, ChangesItsSpeedWithoutKinks)
{
    const Passing way;
    // Returns the largest third difference of the positions, divided by the clearance.
    const auto jerk = [&](const std::vector<Vector>& at) {
        double worst = 0;
        for (std::size_t i = 3; i < at.size(); ++i) {
            const Vector third = at[i] - 3.0 * at[i - 1] + 3.0 * at[i - 2] - at[i - 3];
            worst = std::max(worst, length(third) / way.field.distance(at[i]));
        }
        return worst;
    };
    EXPECT_LT(jerk(way.flown.at), 0.002);
    std::vector<Vector> step = way.flown.at;
    step.erase(step.begin() + 4);
    EXPECT_GT(jerk(step), 0.002);
}

// A flight is shortened if over 8 % of its frames are outside, by at most 6 %.
TEST(Trajectory, BeginsLaterIfTheApproachIsTooLong)
{
    const Bounds bounds{Bounds::Shape::sphere, 1};
    const auto skipped = [&](int outside, int skip) {
        Trajectory ride;
        for (int i = 0; i < 100; ++i) ride.at.push_back({0, 0, i < outside ? 2.0 : 0.5});
        return shortened_by(bounds, ride, 100, skip);
    };
    EXPECT_EQ(skipped(8, 0), 0);
    EXPECT_EQ(skipped(11, 0), 3);
    EXPECT_EQ(skipped(8, 3), 3);
    EXPECT_EQ(skipped(20, 0), 6);
}

// The camera flies one unit per frame along a line before its ends are eased.
TEST(Trajectory, BeginsAndEndsAtRest)
{
    Trajectory ride;
    for (int i = 0; i < 2450; ++i) {
        ride.at.push_back({static_cast<double>(i), 0, 0});
        ride.sample.push_back(2.0 * i);
    }
    ease_ends(ride, 2400);
    ASSERT_EQ(ride.at.size(), 2450U);
    ASSERT_EQ(ride.sample.size(), 2450U);
    const auto step = [&](std::size_t frame) { return ride.at[frame + 1].x - ride.at[frame].x; };
    EXPECT_LT(step(0), 0.02);
    EXPECT_NEAR(step(30), 0.5, 0.02);
    EXPECT_NEAR(step(1200), 1, 1e-9);
    EXPECT_NEAR(step(2399 - 30), 0.5, 0.02);
    EXPECT_LT(step(2398), 0.02);
    EXPECT_NEAR(step(2399), 1, 1e-9);
    EXPECT_NEAR(ride.sample[1000], 2 * ride.at[1000].x, 1e-9);
}

}  // namespace
}  // namespace mandelmarch
