// SPDX-License-Identifier: Apache-2.0
#include "core/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/scene/fractal.h"
#include "core/text/error.h"

namespace mandelmarch {

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
    // length(side) is the sine of the angle between view and up; below 1e-8 the picture's axes are inaccurate.
    if (!(length(side) > 1e-8)) {
        throw InputError(where(Item::up) + ": the up vector is parallel to the view, expected another direction");
    }
    if (const std::string_view objection = scene.fractal->objection(scene); !objection.empty()) {
        throw InputError(fmt::format("{}: {}", where(Item::shape), objection));
    }
    for (const double value : scene.fractal->constants.value(inputs_of(scene)).values) {
        if (!(std::abs(value) < float_range)) {
            throw InputError(where(Item::iterations) +
                             ": the fractal's constants overflow, expected smaller values (a "
                             "scale under 1 wants few iterations)");
        }
    }
}

Sky turned(const Sky& sky, Vector up)
{
    const double both = std::max(1 + dot(sky.up, up), 1e-9);  // 0 for opposite directions
    return {up, unit(sky.north - dot(sky.north, up) / both * (sky.up + up)), sky.sun};
}

Vector sun_at(const Sky& sky, Vector ahead, double height, double azimuth)
{
    constexpr double degree = std::numbers::pi / 180;
    const Vector west = cross(sky.up, sky.north);
    const double heading = std::atan2(dot(ahead, west), dot(ahead, sky.north)) - azimuth * degree;
    const Vector level = std::sin(heading) * west + std::cos(heading) * sky.north;
    return std::cos(height * degree) * level + std::sin(height * degree) * sky.up;
}

const LookValues* look_of(const Scene& scene)
{
    if (scene.look) return &*scene.look;
    return look_named(colouring_names.at(static_cast<std::size_t>(scene.colouring)));
}

}  // namespace mandelmarch
