// SPDX-License-Identifier: Apache-2.0
// Hulls. A hull is a bounding volume, a sphere or a cube around the origin, outside which no ray can hit the surface.
// docs/hulls.md contains the proofs.
#pragma once

#include <functional>

#include "core/scene/fractal.h"

namespace mandelmarch {

// Returns the size of the hull, with a margin for float's rounding errors; 0 if no hull is known. A sample at distance
// t from the eye is a hit if DE < tolerance * t.
double hull_size(const Scene& scene, double tolerance);

// Used by descriptors. bound(r) is a lower bound of DE at all points whose distance from the origin is at least r.
// Returns the smallest radius, from `radius` to 100 times `radius`, at which this bound exceeds the DE of every hit;
// 0 if there is none.
double radius_where(const std::function<double(double)>& bound, double radius, const ViewLimits& view);

// Used by descriptors. Iterates r -> r^P - added and dr -> stretch P r^(P-1) dr + one, from r = start and dr = 1
// until r exceeds `escape`. Returns the min of 0.5 r ln r / dr over these iterations; 0 if r does not escape within
// `iterations`.
double least_estimate(double start, double power, double stretch, double added, double one, double escape,
                      int iterations);

}  // namespace mandelmarch
