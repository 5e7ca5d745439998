// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/scene/fractals/row.h"
#include "core/scene/scene.h"

namespace mandelmarch {
namespace {

constexpr double huge = 1e6;
constexpr double farthest_point = 1e4;  // of a sample's coordinates, with room
constexpr double slow_growth = 1.8;     // more of its orbits need a fifth iteration below

// Of the kernel text: the length at which the sphere fold's factor is 1.
double unit_of(const Scene& scene) { return std::sqrt(std::abs(scene.shape[0])) * scene.shape[2]; }

std::string_view objection(const Scene& scene)
{
    const auto [scale, inner, fixed] = scene.shape;
    if (scale == 0 || scale == 1) return "scale must not be 0 or 1, expected 2 or -1.5, say";
    const double ratio = fixed / inner;
    if (!(std::abs(scale) * ratio * ratio < float_range))
        return "rMin is too small beside rFixed, expected a larger one";
    const double farthest = std::max({scene.escape, inner, farthest_point}) / unit_of(scene);
    if (!(farthest * farthest < float_range))
        return "rFixed is too small beside the escape time, expected a larger one";
    return {};
}

// Where tails of three or four iterations begin; 0 where none is used. Outside, an iteration takes the folded radius r
// to |s| r less what the box fold turns, at most 2 |s| sqrt 3, and plus p. The factor is tried: nearly all
// orbits escape in the third or fourth iteration from there. They hardly come back to the spheres if r is about twice
// the fractal's extent, which no coordinate of p exceeds by much. tests/unit/tail_test.cpp counts those that do not.
double tail_radius(const Scene& scene)
{
    const auto [scale, inner, fixed] = scene.shape;
    const double s = std::abs(scale);
    if (s <= 1 || (scale > 0 && scale < slow_growth) || scene.iterations < 6) return 0;
    const double radius = 0.96 * scene.escape / (s * s * s);
    const double edge = scale > 0 ? 2 * (s + 1) / (s - 1) : 2;
    return radius > std::max({1.9 * edge, 2 * inner, 2 * fixed}) ? radius : 0;
}

FractalConstants constants(const Scene& scene, double, bool tails)
{
    const auto [scale, inner, fixed] = scene.shape;
    const double s = std::abs(scale);
    const double unit = unit_of(scene);
    const auto square = [unit](double length) { return length / unit * (length / unit); };
    const double tail = tails ? tail_radius(scene) : 0;
    return {
        .values = {s, std::copysign(1, scale), square(inner), square(std::max(inner, fixed)), 1 / unit, unit,
                   square(scene.escape), square(tail), std::abs(scale - 1) / unit, std::pow(s, 1 - scene.iterations)},
        .whole = tail > 0 ? scene.iterations - 4 : 0};
}

double hull(const Scene& scene, const Sight& view)
{
    const auto [scale, inner, fixed] = scene.shape;
    const double s = std::abs(scale);
    if (s <= 1 || inner > fixed) return 0;
    // DE >= share (X - edge) - less at a point whose largest coordinate is X > edge.
    const double remainder = std::pow(s, 1 - scene.iterations);
    const double edge = scale > 0 ? 2 * (s + 1) / (s - 1) : 2;
    const double share = scale > 0 ? s * (s - 1) / (s * s + s + 1) : 1;
    const double less =
        scale > 0 ? std::max({0.0, (s - 3) / (s + 1), (s - 1 - edge) / (s * s + s + 1)}) : (s - 1) / (s + 1);
    const double slope = share - std::sqrt(3.0) * view.slope;
    if (!(slope > 0)) return 0;
    return (share * edge + less + remainder + view.slope * view.distance) / slope;
}

double growth(const Scene& scene) { return std::abs(scene.shape[0]); }

}  // namespace

constexpr Fractal rows::mandelbox{
    .name = "mandelbox",
    .nickname = "box",
    .rank = 2,
    .shape = {Meaning{"scale", -huge, huge}, {"rMin", 0, huge, true}, {"rFixed", 0, huge, true}},
    .escape = {"escape time", 0, 1e15, true},
    .objection = objection,
    .constants = constants,
    .hull = {.size = hull, .corner = cube_corner},
    .fast = {.root_share = 0.003, .cone_pitch = 8, .neighbour_pitch = 35},
    .flight = {.growth = growth, .safety = 1, .short_stride = plain_stride},
};

}  // namespace mandelmarch
