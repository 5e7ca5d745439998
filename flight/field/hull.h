// SPDX-License-Identifier: Apache-2.0
// The bounds of a fractal: a body that contains it. The unit "fractal sizes" of many lengths is the size of this body.
#pragma once

#include <string>

#include "core/scene/fractal.h"
#include "core/scene/scene.h"

namespace mandelmarch {

class DistanceField;

// Returns a message of one line that says why the scene's fractal cannot be flown through and which input is expected;
// empty if it can be flown through. Only the scene's shape matters; distances are not computed.
std::string flight_objection(const Scene& scene);

// Throws InputError with the text of flight_objection() if that is not empty.
void check_flown(const Scene& scene);

// Returns the bounds that the fractal's descriptor gives. If it gives none, returns a sphere found by casting rays from
// far outside.
Bounds bounds_of(const Scene& scene, const DistanceField& field);

// Returns the clearance above which the camera does not fly faster: 0.1 fractal sizes. The camera's speed is
// proportional to m = min(clearance, fastest_clearance). Planning therefore measures the cost of a way by its duration,
// the integral of ds / m: its length in clearances.
inline double fastest_clearance(const Bounds& bounds) { return 0.1 * bounds.size; }

}  // namespace mandelmarch
