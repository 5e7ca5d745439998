// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/sight.h"

#include <algorithm>
#include <cmath>

namespace mandelmarch::explore {

std::string word_on(const Scene& scene, double clearance, Precision precision, bool one_colour)
{
    const double farthest = std::max({std::abs(scene.eye.x), std::abs(scene.eye.y), std::abs(scene.eye.z)});
    const double tolerance = std::pow(10, scene.detail);  // of a hit, at distance 1
    if (one_colour) {
        // Inside the solid, the estimate is smaller than the tolerance of a hit at the distance of the fractal's
        // centre.
        if (clearance <= tolerance * farthest) return "the camera is inside the solid";
        return "nothing is in view: the picture has one colour";
    }
    // Rounding moves the eye by up to half a unit in the last place, which must not exceed the nearest hit's tolerance.
    if (precision == Precision::f32 && farthest * 0x1p-24 > tolerance * clearance) {
        return "float's digits are too few so near to the surface: draw in double";
    }
    return {};
}

}  // namespace mandelmarch::explore
