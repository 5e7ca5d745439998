// SPDX-License-Identifier: Apache-2.0
// The sun of a film.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "flight/film/frames.h"

namespace mandelmarch {
namespace {

constexpr int frames = 1800;  // a minute

// Returns a flight whose gaze turns by 90 degrees.
Path turning()
{
    Path path;
    path.scene = official_scene(fractal_named("mandelbulb"), 16, 9);
    for (int i = 0; i < frames; ++i) {
        const double angle = std::numbers::pi / 2 * i / frames;
        Frame frame;
        frame.eye = {3, 0, 0};
        frame.target = frame.eye + Vector{std::sin(angle), 0, std::cos(angle)};
        frame.up = {0, 1, 0};
        frame.field_of_view = 1;
        path.frames.push_back(frame);
    }
    return path;
}

Vector sun_in(const Path& path, std::size_t frame, const std::string& more)
{
    Picture picture;
    picture.look = {.colouring = 2, .values = parse_look("exposure 1\nsun_height 30\n" + more, "a.look")};
    return frame_scene(path, frame, picture).sun;
}

double degrees_between(Vector a, Vector b) { return std::acos(std::min(1.0, dot(a, b))) * 180 / std::numbers::pi; }

TEST(Sun, TurnsWithTheWayOnlyIfTheLookRequiresIt)
{
    const Path path = turning();
    EXPECT_EQ(sun_in(path, 0, ""), sun_in(path, frames - 1, ""));
    EXPECT_GT(degrees_between(sun_in(path, 0, "sun_follows 1"), sun_in(path, frames - 1, "sun_follows 1")), 30);
}

TEST(Sun, IsAtTheHeightOfTheLook)
{
    for (const char* const more : {"", "sun_follows 1"}) {
        const Vector sun = sun_in(turning(), 900, more);
        EXPECT_NEAR(sun.y, 0.5, 1e-12);
        EXPECT_NEAR(length(sun), 1, 1e-12);
    }
}

TEST(Sun, MovesSmoothlyAndStaysBesideTheGaze)
{
    const Path path = turning();
    Vector before = sun_in(path, 0, "sun_follows 1");
    for (std::size_t frame = 1; frame < frames; ++frame) {
        const Vector sun = sun_in(path, frame, "sun_follows 1");
        EXPECT_LT(degrees_between(sun, before), 0.2) << frame;
        const Vector gaze = path.frames[frame].target - path.frames[frame].eye;
        EXPECT_NEAR(degrees_between(unit(Vector{sun.x, 0, sun.z}), gaze), 110, 20) << frame;
        EXPECT_GT(dot(sun, cross(gaze, {0, 1, 0})), 0.5) << frame;  // on the right
        before = sun;
    }
}

}  // namespace
}  // namespace mandelmarch
