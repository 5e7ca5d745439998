// SPDX-License-Identifier: Apache-2.0
// Hulls: the sphere or cube around the origin outside which no ray can hit a fractal's surface. docs/hulls.md has the
// proofs.
#pragma once

#include <functional>

#include "core/scene/fractal.h"

namespace mandelmarch {

// The hull of a scene whose surface is where DE < tolerance t, with room for the rounding of floats; 0 where none is
// proven.
double hull_size(const Scene& scene, double tolerance);

// For rows. The smallest radius at which `bound`, a lower bound of DE at that distance from the origin and beyond,
// exceeds what a hit could have there; 0 if there is none up to 100 times `radius`.
double radius_where(const std::function<double(double)>& bound, double radius, const Sight& view);

// For rows. The least 0.5 r ln r / dr along r -> r^P - added, dr -> stretch P r^(P-1) dr + one, from r = start up to an
// escape; 0 without an escape in `iterations`.
double least_estimate(double start, double power, double stretch, double added, double one, double escape,
                      int iterations);

}  // namespace mandelmarch
