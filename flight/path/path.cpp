// SPDX-License-Identifier: Apache-2.0
#include "flight/path/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/render/stepping.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace {

constexpr double footprint = 1;             // pixel heights; size of the smallest detail
constexpr double least_clearance = 0.0025;  // fractal sizes; the smallest clearance that a path should have
constexpr int spare_iterations = 1;

// Returns the number of iterations that a picture can show. Even from the smallest clearance, the features of further
// iterations are smaller than a pixel. They would only add noise, and they are the slowest part of a close-up.
int iterations_in_sight(const Scene& scene)
{
    const double growth = std::max(scene.fractal->flight.growth(scene), 1.1);
    const double smallest = std::pow(10.0, scene.detail) * least_clearance;
    return static_cast<int>(std::ceil(-std::log(smallest) / std::log(growth))) + spare_iterations;
}

}  // namespace

Scene scene_of(const Path& path, const Frame& frame, int width, int height)
{
    Scene scene = path.scene;
    scene.eye = frame.eye;
    scene.target = frame.target;
    scene.up = frame.up;
    scene.field_of_view = frame.field_of_view;
    scene.width = width;
    scene.height = height;
    const Changes& changes = frame.changes;
    if (changes.detail) {
        scene.detail = *changes.detail;
    } else if (path.detail_by_size) {
        const double tangent = std::tan(frame.field_of_view * degrees_per_field / 2 * std::numbers::pi / 180);
        scene.detail = static_cast<float>(std::clamp(std::log10(footprint * 2 * tangent / height), -6.0, -1.5));
    }
    if (changes.shape) scene.shape = *changes.shape;
    if (changes.iterations) scene.iterations = *changes.iterations;
    if (changes.escape) scene.escape = *changes.escape;
    if (changes.colouring) scene.colouring = *changes.colouring;
    if (changes.brightness) scene.brightness = *changes.brightness;
    return scene;
}

Scene picture_of(const Path& path, const Frame& frame, int width, int height)
{
    Scene scene = scene_of(path, frame, width, height);
    if (!path.detail_by_size) return scene;
    if (!frame.changes.iterations) scene.iterations = std::min(scene.iterations, iterations_in_sight(scene));
    scene.limits = film_limits(scene);
    scene.smooth = true;
    return scene;
}

Tilt tilt_of(const Frame& frame, Vector upward)
{
    const Vector gaze = unit(frame.target - frame.eye);
    const Vector up = unit(frame.up - dot(frame.up, gaze) * gaze);
    const Vector level = upward - dot(upward, gaze) * gaze;
    return {std::atan2(dot(cross(up, level), gaze), dot(up, level)), dot(level, level)};
}

Tilt tilt_of(const Frame& frame, const Fractal& fractal)
{
    return tilt_of(frame, fractal.flight.upward(frame.eye, frame.up));
}

Frame rolled(Frame frame, double angle)
{
    const Vector gaze = unit(frame.target - frame.eye);
    frame.up = std::cos(angle) * frame.up + std::sin(angle) * cross(gaze, frame.up);
    return frame;
}

}  // namespace mandelmarch
