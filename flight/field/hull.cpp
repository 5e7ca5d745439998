// SPDX-License-Identifier: Apache-2.0
#include "flight/field/hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/scene/parameter_file.h"
#include "flight/field/field.h"

namespace mandelmarch {
namespace {

// Returns a sphere around the origin that contains the fractal. Rays are cast from far outside towards the origin; the
// radius is that of the outermost hit plus 2 %, and at least 0.1.
Bounds sphere_by_rays(const DistanceField& field)
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
    return {Bounds::Shape::sphere, std::max(1.02 * (far - nearest), 0.1)};
}

}  // namespace

std::string flight_objection(const Scene& scene)
{
    const Fractal& fractal = *scene.fractal;
    // A fractal's own `body` returns nullopt if the shape is unbounded or has no inside.
    if (fractal.flight.body == defaults::unknown_body || fractal.flight.body(scene)) return {};
    const Scene official = official_scene(fractal);
    for (std::size_t i = 0; i < fractal.shape.size(); ++i) {
        Scene other = scene;
        other.shape[i] = official.shape[i];
        if (!fractal.flight.body(other)) continue;
        const std::string_view name = fractal.shape[i].name;
        return fmt::format("a {} with {} {:.6g} cannot be flown through, expected another {}, {:.6g}, say",
                           fractal.name, name, scene.shape[i], name, official.shape[i]);
    }
    return fmt::format("this {} cannot be flown through, expected another shape", fractal.name);
}

void check_flown(const Scene& scene)
{
    if (const std::string objection = flight_objection(scene); !objection.empty()) throw InputError(objection);
}

Bounds bounds_of(const Scene& scene, const DistanceField& field)
{
    const std::optional<Bounds> known = scene.fractal->flight.body(scene);
    return known ? *known : sphere_by_rays(field);
}

}  // namespace mandelmarch
