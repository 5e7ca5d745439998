// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/text/quantile.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "flight/path/measures.h"
#include "flight/path/path.h"

namespace mandelmarch {
namespace {

constexpr double most_jerk = 0.3;         // threshold, as a multiple of the cube of the pace in clearances / s
constexpr double most_angular_jerk = 30;  // threshold, degrees / s^3
constexpr double some_horizon = 0.25;     // the value of Tilt::horizon for a gaze 30 degrees from vertical
constexpr double level = 30;              // degrees; a picture with a smaller tilt looks level

// Returns, for each frame but the last, the rotation from its camera to the next frame's. A rotation is a vector: its
// direction is the axis, and its length is the angle in radians.
std::vector<Vector> rotations(const Path& path)
{
    const auto camera = [&](std::size_t i) { return camera_of(scene_of(path, path.frames[i], 16, 9)); };
    std::vector<Vector> all;
    all.reserve(path.frames.size());
    Camera before = camera(0);
    for (std::size_t i = 1; i < path.frames.size(); ++i) {
        const Camera now = camera(i);
        const Vector r0 = unit(before.across);
        const Vector u0 = unit(before.upward);
        const Vector r1 = unit(now.across);
        const Vector u1 = unit(now.upward);
        const double trace = dot(before.forward, now.forward) + dot(r0, r1) + dot(u0, u1);
        const Vector axis = 0.5 * (cross(before.forward, now.forward) + cross(r0, r1) + cross(u0, u1));
        const double sine = length(axis);
        const double angle = std::atan2(sine, (trace - 1) / 2);
        all.push_back(sine > 0 ? (angle / sine) * axis : axis);
        before = now;
    }
    return all;
}

double percentile_95(const std::vector<double>& values) { return values.empty() ? 0 : quantile(values, 0.95); }

}  // namespace

std::vector<double> turns_of(const Path& path)
{
    std::vector<double> turns{0};
    for (const Vector& rotation : rotations(path)) turns.push_back(length(rotation) * 180 / std::numbers::pi);
    return turns;
}

std::vector<Row> jerk_rows(const Path& path, std::span<const double> clearances)
{
    const double cube = std::pow(path.frames_per_second, 3);
    std::vector<double> jerk;
    for (std::size_t i = 3; i < path.frames.size(); ++i) {
        const auto eye = [&](std::size_t back) { return path.frames[i - back].eye; };
        const Vector third = eye(0) - 3.0 * eye(1) + 3.0 * eye(2) - eye(3);
        jerk.push_back(length(third) * cube / std::max(clearances[i], 1e-300));
    }
    const std::vector<Vector> turned = rotations(path);
    std::vector<double> angular;
    for (std::size_t i = 2; i < turned.size(); ++i) {
        const Vector second = turned[i] - 2.0 * turned[i - 1] + turned[i - 2];
        angular.push_back(length(second) * cube * 180 / std::numbers::pi);
    }
    const double pace = flight_measures(*path.scene.fractal).pace * frames_per_second;
    const double bar = most_jerk * pace * pace * pace;
    return {{"jerk, 95 of 100 frames", percentile_95(jerk), bar, true, false, "DE/s^3"},
            {"angular jerk, 95 of 100 frames", percentile_95(angular), most_angular_jerk, true, false, "deg/s^3"}};
}

Row level_row(const Path& path)
{
    std::size_t horizons = 0;
    std::size_t held = 0;
    for (const Frame& frame : path.frames) {
        const Tilt tilt = tilt_of(frame, *path.scene.fractal);
        if (tilt.horizon < some_horizon) continue;
        ++horizons;
        held += std::abs(tilt.angle) < level * std::numbers::pi / 180 ? 1 : 0;
    }
    const double share = horizons > 0 ? 100.0 * static_cast<double>(held) / static_cast<double>(horizons) : 100;
    return {"frames with a horizon that are within 30 deg of level", share, 75, false, false, "%"};
}

Stand longest_stand(std::span<const Vector> places, std::span<const double> radii)
{
    Stand longest;
    std::size_t outside = 0;  // index of the first place outside the last stand's radius
    for (std::size_t i = 0; i + longest.steps + 1 < places.size(); ++i) {
        const auto within = [&](std::size_t j) {
            ++longest.distances;
            return length(places[j] - places[i]) <= radii[i];
        };
        // If the stand that begins at i is longer than the longest so far, it includes `far` and every place before
        // `far`. Among these, the place `outside`, which ended the last stand, is the most likely to end this one, too.
        // Therefore these two places are tested before the others.
        const std::size_t far = i + longest.steps + 1;
        if (!within(far) || (outside > i && outside < far && !within(outside))) continue;
        outside = i + 1;
        while (outside < places.size() && within(outside)) ++outside;
        if (outside - 1 - i > longest.steps) {
            longest.steps = outside - 1 - i;
            longest.first = i;
        }
    }
    return longest;
}

}  // namespace mandelmarch
