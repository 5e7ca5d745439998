// SPDX-License-Identifier: Apache-2.0
#include "flight/field/hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/scene/fractal.h"
#include "flight/field/field.h"

namespace mandelmarch {
namespace {

// The largest radius at which one of many rays towards the middle ends, with a margin.
Hull sphere_by_rays(const Field& field)
{
    constexpr int rays = 4000;
    constexpr double far = 20;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Vector> from;
    std::vector<Vector> towards;
    for (int i = 0; i < rays; ++i) {
        const double z = 1 - (2 * i + 1.0) / rays;
        const double rho = std::sqrt(1 - z * z);
        const Vector direction{rho * std::cos(golden * i), rho * std::sin(golden * i), z};
        from.push_back(far * direction);
        towards.push_back(-1 * direction);
    }
    std::vector<double> t(from.size());
    field.casts(from, towards, {.floor = 1e-3, .tolerance = 0, .end = far, .steps = 1000}, t);
    const double nearest = *std::ranges::min_element(t);
    return {Hull::Shape::sphere, std::max(1.02 * (far - nearest), 0.1)};
}

bool is(const Scene& scene, const char* nickname) { return scene.fractal->nickname == nickname; }

}  // namespace

bool Hull::contains(Vector p) const
{
    if (shape == Shape::sphere) return length(p) <= size;
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= size;
}

Hull hull_of(const Scene& scene, const Field& field)
{
    if (is(scene, "box")) {
        const double s = scene.shape[0];
        if (s > 1) return {Hull::Shape::cube, 2 * (s + 1) / (s - 1)};
        if (s < -1) return {Hull::Shape::cube, 2};
    }
    if (is(scene, "bulb") && scene.shape[2] > 1.2) return {Hull::Shape::sphere, std::pow(2, 1 / (scene.shape[2] - 1))};
    return sphere_by_rays(field);
}

bool worth_searching(const Scene& scene, const Hull& hull, Vector p)
{
    if (is(scene, "box")) return std::min({p.x, p.y, p.z}) > -0.1 * hull.size;
    if (!is(scene, "bulb")) return true;
    const double power = scene.shape[2];
    const bool whole = power == std::floor(power) && power >= 2;
    const double wedge = whole ? 2.1 * std::numbers::pi / (power - 1) : 1.1 * std::numbers::pi;
    return std::abs(std::atan2(p.y, p.x)) < wedge;
}

Vector representative(const Scene& scene, Vector p)
{
    if (is(scene, "box")) {
        std::array<double, 3> c{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
        std::ranges::sort(c);
        return {c[0], c[1], c[2]};
    }
    if (!is(scene, "bulb")) return p;
    const double power = scene.shape[2];
    const bool whole = power == std::floor(power) && power >= 2;
    double angle = std::abs(std::atan2(p.y, p.x));
    if (whole) {
        const double turn = 2 * std::numbers::pi / (power - 1);
        angle = std::abs(angle - turn * std::round(angle / turn));
    }
    const double rho = std::hypot(p.x, p.y);
    const bool odd = whole && std::fmod(power, 2) == 1;
    return {rho * std::cos(angle), rho * std::sin(angle), odd ? std::abs(p.z) : p.z};
}

}  // namespace mandelmarch
