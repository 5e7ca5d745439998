// SPDX-License-Identifier: Apache-2.0
#include "core/scene/fractal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/scene/hull.h"
#include "core/scene/scene.h"

namespace mandelmarch {
namespace {

constexpr double huge = 1e6;
constexpr double largest = 1e37;        // of a float, with room
constexpr double farthest_point = 1e4;  // of a sample's coordinates, with room
constexpr double bulb_short_stride = 0.6;
constexpr double bulb_low_power_stride = 0.4;
constexpr double slow_growth = 1.8;  // of the Mandelbox: more of its orbits need a fifth iteration below
constexpr Meaning ignored{"a number (ignored)", -1e300, 1e300};

std::string_view no_objection(const Scene&) { return {}; }

// Of the Mandelbox's kernel text: the length at which the sphere fold's factor is 1.
double box_unit(const Scene& scene) { return std::sqrt(std::abs(scene.shape[0])) * scene.shape[2]; }

std::string_view box_objection(const Scene& scene)
{
    const auto [scale, inner, fixed] = scene.shape;
    if (scale == 0 || scale == 1) return "scale must not be 0 or 1, expected 2 or -1.5, say";
    const double ratio = fixed / inner;
    if (!(std::abs(scale) * ratio * ratio < largest)) return "rMin is too small beside rFixed, expected a larger one";
    const double farthest = std::max({scene.escape, inner, farthest_point}) / box_unit(scene);
    if (!(farthest * farthest < largest)) return "rFixed is too small beside the escape time, expected a larger one";
    return {};
}

// The bailout radius is cut so that r^3P stays finite: gradients have products of r^P and its slope.
FractalConstants bulb_constants(const Scene& scene, double most, bool)
{
    const double power = scene.shape[2];
    const double bailout = std::min(scene.shape[1], std::pow(most, 1 / (3 * power)));
    return {.values = {bailout, power}, .whole = power == std::floor(power) ? static_cast<int>(power) : 0};
}

// Where tails of three or four iterations begin; 0 where none is used. Outside, an iteration takes the folded radius r
// to |s| r less what the box fold turns, at most 2 |s| sqrt 3, and plus p. The factor is tried: nearly all
// orbits escape in the third or fourth iteration from there. They hardly come back to the spheres if r is about twice
// the fractal's extent, which no coordinate of p exceeds by much. tests/unit/tail_test.cpp counts those that do not.
double box_tail_radius(const Scene& scene)
{
    const auto [scale, inner, fixed] = scene.shape;
    const double s = std::abs(scale);
    if (s <= 1 || (scale > 0 && scale < slow_growth) || scene.iterations < 6) return 0;
    const double radius = 0.96 * scene.escape / (s * s * s);
    const double edge = scale > 0 ? 2 * (s + 1) / (s - 1) : 2;
    return radius > std::max({1.9 * edge, 2 * inner, 2 * fixed}) ? radius : 0;
}

FractalConstants box_constants(const Scene& scene, double, bool tails)
{
    const auto [scale, inner, fixed] = scene.shape;
    const double s = std::abs(scale);
    const double unit = box_unit(scene);
    const auto square = [unit](double length) { return length / unit * (length / unit); };
    const double tail = tails ? box_tail_radius(scene) : 0;
    return {
        .values = {s, std::copysign(1, scale), square(inner), square(std::max(inner, fixed)), 1 / unit, unit,
                   square(scene.escape), square(tail), std::abs(scale - 1) / unit, std::pow(s, 1 - scene.iterations)},
        .whole = tail > 0 ? scene.iterations - 4 : 0};
}

// c = shape + escape k. Far outside the estimate is better the larger the radius; this one keeps r^2 in float's range.
FractalConstants julia_constants(const Scene& scene, double, bool)
{
    constexpr double escape_radius = 1000;
    const auto [a, i, j] = scene.shape;
    return {.values = {a, i, j, scene.escape, escape_radius * escape_radius}};
}

// z^2 doubles where |z| is 1, as it is about the surface.
double julia_growth(const Scene&) { return 2; }

double any_stride(const Scene&) { return default_stride; }

// At low powers longer steps miss more of what is thin: docs/notes/experiments.md.
double bulb_fast_stride(const Scene& scene) { return scene.shape[2] < 4.5 ? bulb_low_power_stride : default_stride; }

double bulb_growth(const Scene& scene) { return scene.shape[2]; }

double box_growth(const Scene& scene) { return std::abs(scene.shape[0]); }

constexpr double sphere_corner = 1;
constexpr double cube_corner = 1.7320508075688772;  // sqrt(3)

// One row registers a fractal.
constexpr std::array table{
    Fractal{"mandelbulb",
            "bulb",
            {ignored, {"bailout", 0, huge, true}, {"power", 0, 1000, true}},
            ignored,
            no_objection,
            bulb_constants,
            bulb_hull,
            sphere_corner,
            bulb_growth,
            bulb_fast_stride,
            0.8,
            bulb_short_stride,
            40,
            48,
            0.02},
    Fractal{"mandelbox",
            "box",
            {Meaning{"scale", -huge, huge}, {"rMin", 0, huge, true}, {"rFixed", 0, huge, true}},
            {"escape time", 0, 1e15, true},
            box_objection,
            box_constants,
            box_hull,
            cube_corner,
            box_growth,
            any_stride,
            1,
            default_stride,
            8,
            35,
            0.003},
    Fractal{"julia",
            "julia",
            {Meaning{"c's real part", -4, 4}, {"c's i part", -4, 4}, {"c's j part", -4, 4}},
            {"c's k part", -4, 4},
            no_objection,
            julia_constants,
            julia_hull,
            sphere_corner,
            julia_growth,
            any_stride,
            1,
            default_stride,
            40,
            48,
            0.01},
};

}  // namespace

std::span<const Fractal> fractals() { return table; }

const Fractal& fractal_named(std::string_view name)
{
    std::string known;
    for (const Fractal& fractal : table) {
        if (fractal.name == name || fractal.nickname == name) return fractal;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", fractal.name);
    }
    throw InputError(fmt::format("no fractal is called '{}', expected one of {}", name, known));
}

void check_scene(const Scene& scene, const std::function<std::string(Item)>& where)
{
    const Vector view = scene.target - scene.eye;
    const double distance = std::hypot(view.x, view.y, view.z);
    if (!(distance > 0)) {
        throw InputError(where(Item::target) + ": the camera stands on its target, expected another look-at point");
    }
    const double up_length = std::hypot(scene.up.x, scene.up.y, scene.up.z);
    if (!(up_length > 0)) throw InputError(where(Item::up) + ": the up vector is zero, expected a direction");
    const Vector side = cross((1 / distance) * view, (1 / up_length) * scene.up);
    // The sine of an angle that leaves no digits for the picture's axes.
    if (!(length(side) > 1e-8)) {
        throw InputError(where(Item::up) + ": the up vector is parallel to the view, expected another direction");
    }
    if (const std::string_view objection = scene.fractal->objection(scene); !objection.empty()) {
        throw InputError(fmt::format("{}: {}", where(Item::shape), objection));
    }
    for (const double value : scene.fractal->constants(scene, largest, false).values) {
        if (!(std::abs(value) < largest)) {
            throw InputError(where(Item::iterations) +
                             ": the fractal's constants overflow, expected smaller values (a "
                             "scale under 1 wants few iterations)");
        }
    }
}

}  // namespace mandelmarch
