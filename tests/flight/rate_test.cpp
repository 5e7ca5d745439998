// SPDX-License-Identifier: Apache-2.0
// A flight at another frame rate visits the same places at the same times, and keeps the same promises, whose limits
// are per second.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "flight/path/path.h"
#include "tests/flight/rows.h"

namespace mandelmarch {
namespace {

// Returns a camera on a circle around the Mandelbulb, at an angle in radians.
Frame on_circle(double angle)
{
    Frame frame;
    frame.eye = {4 * std::cos(angle), 4 * std::sin(angle), 1};
    frame.target = {std::cos(angle + 1), std::sin(angle + 1), 0};
    frame.up = {0, 0, 1};
    frame.field_of_view = 1 + 0.1 * std::sin(angle);
    return frame;
}

constexpr double a_frame = 0.01;  // radians per frame

Path circle(int frames)
{
    Path path;
    path.scene = official_scene(fractal_named("mandelbulb"), 16, 9);
    for (int i = 0; i < frames; ++i) path.frames.push_back(on_circle(a_frame * i));
    cut_digits(path);
    return path;
}

class Rates : public testing::TestWithParam<int> {};

TEST_P(Rates, ThePlacesAreThoseOfTheFlight)
{
    const int rate = GetParam();
    const int frames = 4 * rate;
    const Path path = circle(frames_at_rate(frames, frames_per_second, rate));
    const Path other = at_rate(path, frames, rate);
    ASSERT_EQ(other.frames.size(), static_cast<std::size_t>(frames));
    EXPECT_EQ(other.frames_per_second, rate);
    for (int i = 0; i < frames; ++i) {
        const Frame wanted = on_circle(a_frame * i * frames_per_second / rate);
        const Frame& found = other.frames[static_cast<std::size_t>(i)];
        // A natural spline has no curvature at its ends. Therefore it deviates more from the circle there.
        const double most = i < rate / 2 || i > frames - rate / 2 ? 1e-4 : 1e-8;
        EXPECT_LT(length(found.eye - wanted.eye), most) << i;
        EXPECT_LT(length(found.target - wanted.target), most) << i;
        EXPECT_NEAR(found.field_of_view, wanted.field_of_view, most) << i;
    }
}

TEST_P(Rates, PromisesHoldBySecond)
{
    const int rate = GetParam();
    const int frames = 2 * rate;
    const Audit usual = audit_promises(circle(60), 1);
    const Audit other =
        audit_promises(at_rate(circle(frames_at_rate(frames, frames_per_second, rate)), frames, rate), 1);
    for (const std::string name : {"largest step between frames / DE", "largest turn per frame"}) {
        const Row& found = row_of(other, name);
        const Row& wanted = row_of(usual, name);
        EXPECT_NEAR(found.bar * rate, wanted.bar * frames_per_second, 1e-9) << name;
        EXPECT_NEAR(found.value * rate, wanted.value * frames_per_second, 0.01 * wanted.value * frames_per_second)
            << name;
    }
    const std::string standing = "longest time standing still";
    EXPECT_NEAR(row_of(other, standing).value, row_of(usual, standing).value, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Of, Rates, testing::Values(24, 25, 50, 60, 120));

TEST(Rate, TheRateOfAPathChangesNothing)
{
    const Path path = circle(90);
    EXPECT_EQ(to_text(at_rate(path, 90, frames_per_second)), to_text(path));
}

TEST(Rate, AShapeThatChangesIsBetweenTwoFramesShapes)
{
    Path path = circle(3);
    for (std::size_t i = 0; i < 3; ++i) path.frames[i].changes.shape = {0, 4, 8 - static_cast<double>(i)};
    const Path other = at_rate(path, 5, 60);
    for (std::size_t i = 0; i < 5; ++i) {
        ASSERT_TRUE(other.frames[i].changes.shape);
        EXPECT_EQ((*other.frames[i].changes.shape)[2], 8 - 0.5 * static_cast<double>(i));
    }
}

}  // namespace
}  // namespace mandelmarch
