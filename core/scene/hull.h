// SPDX-License-Identifier: Apache-2.0
// Hulls: bounding volumes, a sphere or cube around the origin outside which no ray can hit the surface. docs/hulls.md
// contains the proofs.
#pragma once

#include <functional>

#include "core/scene/fractal.h"

namespace mandelmarch {

// Returns the hull's size for a surface where DE < tolerance t, with a margin for float rounding; 0: no proven hull.
double hull_size(const Scene& scene, double tolerance);

// For descriptors. `bound` is a lower bound of DE at a distance from the origin and beyond. Returns the smallest radius
// at which it exceeds the DE of any hit; 0 if there is none up to 100 times `radius`.
double radius_where(const std::function<double(double)>& bound, double radius, const ViewLimits& view);

// For descriptors. Returns the min of 0.5 r ln r / dr along r -> r^P - added, dr -> stretch P r^(P-1) dr + one, from r
// = start up to an escape; 0 without an escape in `iterations`.
double least_estimate(double start, double power, double stretch, double added, double one, double escape,
                      int iterations);

}  // namespace mandelmarch
