// SPDX-License-Identifier: Apache-2.0
// The bounds of a fractal: a body that contains it. Many lengths are in units of its size, "fractal sizes".
#pragma once

#include <string>

#include "core/scene/fractal.h"
#include "core/scene/scene.h"

namespace mandelmarch {

class DistanceField;

// Returns the reason why the scene's fractal cannot be flown through, in one line with the expected input; empty if it
// can be. Depends on the scene's shape alone and computes no distance.
std::string flight_objection(const Scene& scene);

// Throws InputError with flight_objection(), if any.
void check_flown(const Scene& scene);

// Returns the bounds given by the fractal's descriptor, or else a sphere found by rays from far outside.
Bounds bounds_of(const Scene& scene, const DistanceField& field);

// Returns the clearance above which the camera flies no faster: 0.1 fractal sizes. Costs are distances in clearances,
// the integral of ds / min(clearance, this), because the camera's speed is proportional to min(clearance, this).
inline double fastest_clearance(const Bounds& bounds) { return 0.1 * bounds.size; }

}  // namespace mandelmarch
