// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/scene/fractals/row.h"
#include "core/scene/hull.h"
#include "core/scene/scene.h"

namespace mandelmarch {
namespace {

constexpr double short_stride = 0.6;
constexpr double low_power_stride = 0.4;

// The bailout radius is cut so that r^3P stays finite: gradients have products of r^P and its slope.
FractalConstants constants(const Scene& scene, double most, bool)
{
    const double power = scene.shape[2];
    const double bailout = std::min(scene.shape[1], std::pow(most, 1 / (3 * power)));
    return {.values = {bailout, power}, .whole = power == std::floor(power) ? static_cast<int>(power) : 0};
}

double hull(const Scene& scene, const Sight& view)
{
    const double escape = scene.shape[1];
    const double power = scene.shape[2];
    if (power <= 1) return 0;
    // The estimator leaves out the last radius, so that the escape must come before.
    const auto bound = [&](double r) { return least_estimate(r, power, r, 1, escape, scene.iterations - 1); };
    return radius_where(bound, std::pow(2, 1 / (power - 1)), view);
}

// At low powers longer steps miss more of what is thin: docs/notes/experiments.md.
double stride(const Scene& scene) { return scene.shape[2] < 4.5 ? low_power_stride : plain_stride; }

double growth(const Scene& scene) { return scene.shape[2]; }

}  // namespace

constexpr Fractal rows::mandelbulb{
    .name = "mandelbulb",
    .nickname = "bulb",
    .rank = 1,
    .shape = {ignored_number, {"bailout", 0, 1e6, true}, {"power", 0, 1000, true}},
    .escape = ignored_number,
    .constants = constants,
    .hull = {.size = hull, .corner = sphere_corner},
    .fast = {.stride = stride, .root_share = 0.02, .cone_pitch = 40, .neighbour_pitch = 48},
    .flight = {.growth = growth, .safety = 0.8, .short_stride = short_stride},
};

}  // namespace mandelmarch
