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

constexpr std::size_t camera_numbers = 10;  // location, look_at, up, field of view
using CameraNumbers = std::array<double, camera_numbers>;

CameraNumbers numbers_of(const Frame& frame)
{
    return {frame.eye.x,    frame.eye.y, frame.eye.z, frame.target.x, frame.target.y,
            frame.target.z, frame.up.x,  frame.up.y,  frame.up.z,     frame.field_of_view};
}

Frame with_numbers(Frame frame, const CameraNumbers& n)
{
    frame.eye = {n[0], n[1], n[2]};
    frame.target = {n[3], n[4], n[5]};
    frame.up = {n[6], n[7], n[8]};
    frame.field_of_view = n[9];
    return frame;
}

// Returns the second derivatives M (per frame squared) of the natural cubic spline through the values v. They satisfy
// M[i-1] + 4 M[i] + M[i+1] = 6 (v[i-1] - 2 v[i] + v[i+1]). Thomas's algorithm solves these equations.
std::vector<CameraNumbers> bends(const std::vector<CameraNumbers>& values)
{
    const std::size_t count = values.size();
    std::vector<CameraNumbers> bend(count, CameraNumbers{});
    if (count < 3) return bend;
    std::vector<double> share(count, 0);  // coefficient of M[i+1] in equation i after elimination
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double whole = 4 - share[i - 1];
        share[i] = 1 / whole;
        for (std::size_t k = 0; k < camera_numbers; ++k) {
            const double second = 6 * (values[i - 1][k] - 2 * values[i][k] + values[i + 1][k]);
            bend[i][k] = (second - bend[i - 1][k]) / whole;
        }
    }
    for (std::size_t i = count - 2; i > 0; --i) {
        for (std::size_t k = 0; k < camera_numbers; ++k) bend[i][k] -= share[i] * bend[i + 1][k];
    }
    return bend;
}

constexpr double most_turn = 7.5;  // degrees per second; the sky turns no faster than the planner rolls the camera
constexpr double delay = 1.5;      // seconds; time constant of turned_towards()
constexpr double lead = 4;         // seconds by which the sky looks ahead, because it turns late

// Returns the direction `from`, turned towards `to` for `seconds`; the closer they are, the slower it turns.
Vector turned_towards(Vector from, Vector to, double seconds)
{
    if (dot(from, to) < -0.99) to = Vector{0.1, 0.2, 0.3} + to;  // chooses one of many ways
    const Vector aside = to - dot(to, from) * from;
    const double share = std::min(1.0, seconds / delay) * std::atan2(length(aside), dot(to, from));
    const double step = std::min(most_turn * std::numbers::pi / 180 * seconds, share);
    return unit(std::cos(step) * from + std::sin(step) / std::max(length(aside), 1e-9) * aside);
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

std::vector<Sky> skies_of(const Path& path)
{
    const double seconds = static_cast<double>(path.every) / path.frames_per_second;
    const auto upward = [&](std::size_t i) {
        const Frame& frame = path.frames[std::min(i, path.frames.size() - 1)];
        return unit(path.scene.fractal->flight.upward(frame.eye, frame.up));
    };
    Vector aim = upward(0);
    std::vector<Sky> skies{turned({}, aim)};
    while (skies.size() < path.frames.size()) {
        // Turning twice makes the speed change smoothly.
        aim = turned_towards(aim, upward(skies.size() + static_cast<std::size_t>(lead / seconds)), seconds);
        skies.push_back(turned(skies.back(), turned_towards(skies.back().up, aim, seconds)));
    }
    return skies;
}

Frame rolled(Frame frame, double angle)
{
    const Vector gaze = unit(frame.target - frame.eye);
    frame.up = std::cos(angle) * frame.up + std::sin(angle) * cross(gaze, frame.up);
    return frame;
}

int frames_at_rate(int frames, int from, int to)
{
    const auto steps = static_cast<std::int64_t>(frames - 1) * from;
    return static_cast<int>((steps + to - 1) / to) + 1;
}

Path at_rate(const Path& path, int frames, int rate)
{
    const auto last = static_cast<std::int64_t>(path.frames.size()) - 1;
    frames = static_cast<int>(std::min<std::int64_t>(frames, last * rate / path.frames_per_second + 1));
    Path result = path;
    if (rate == path.frames_per_second) {
        result.frames.resize(static_cast<std::size_t>(frames));
        return result;
    }
    std::vector<CameraNumbers> values;
    for (const Frame& frame : path.frames) values.push_back(numbers_of(frame));
    const std::vector<CameraNumbers> bend = bends(values);
    result.frames_per_second = rate;
    result.frames.clear();
    for (int f = 0; f < frames; ++f) {
        const double at = static_cast<double>(f) * path.frames_per_second / rate;
        const auto first = std::min(static_cast<std::size_t>(at), path.frames.size() - 1);
        const std::size_t second = std::min(first + 1, path.frames.size() - 1);
        const double b = std::clamp(at - static_cast<double>(first), 0.0, 1.0);
        const double a = 1 - b;
        CameraNumbers between{};
        for (std::size_t k = 0; k < camera_numbers; ++k) {
            between[k] = a * values[first][k] + b * values[second][k] +
                         ((a * a * a - a) * bend[first][k] + (b * b * b - b) * bend[second][k]) / 6;
        }
        Frame frame = with_numbers(path.frames[first], between);
        const auto& from = path.frames[first].changes.shape;
        const auto& to = path.frames[second].changes.shape;
        if (from || to) {
            auto shape = from.value_or(path.scene.shape);
            const auto& next = to ? *to : path.scene.shape;
            for (std::size_t k = 0; k < shape.size(); ++k) shape[k] = static_cast<float>(a * shape[k] + b * next[k]);
            frame.changes.shape = shape;
        }
        result.frames.push_back(frame);
    }
    cut_digits(result);
    return result;
}

}  // namespace mandelmarch
