// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/sight.h"

#include <algorithm>
#include <cmath>

namespace mandelmarch::explore {

std::string word_on(const Scene& scene, double clearance, Precision precision, bool one_colour)
{
    const double farthest = std::max({std::abs(scene.eye.x), std::abs(scene.eye.y), std::abs(scene.eye.z)});
    const double tolerance = std::pow(10, scene.detail);  // tolerance of a hit at distance 1
    if (one_colour) {
        // The eye is taken to be inside the solid if the estimate is at most the tolerance of a hit as far away as the
        // fractal's centre.
        if (clearance <= tolerance * farthest) return "the camera is inside the solid";
        return "nothing is in view: the picture has one colour";
    }
    // Rounding to float moves the eye by up to half a unit in the last place. The picture is wrong if this is more than
    // the tolerance of a hit at the distance of the clearance.
    if (precision == Precision::f32 && farthest * 0x1p-24 > tolerance * clearance) {
        return "float's digits are too few so near to the surface: draw in double";
    }
    return {};
}

}  // namespace mandelmarch::explore
