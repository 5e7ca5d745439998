// SPDX-License-Identifier: Apache-2.0
// Hulls: the sphere or cube around the origin outside which no ray can hit a fractal's surface. docs/hulls.md has the
// proofs.
#pragma once

#include "core/scene/fractal.h"

namespace mandelmarch {

double box_hull(const Scene& scene, const Sight& view);
double bulb_hull(const Scene& scene, const Sight& view);
double julia_hull(const Scene& scene, const Sight& view);

// The hull of a scene whose surface is where DE < tolerance t, with room for the rounding of floats; 0 where none is
// proven.
double hull_size(const Scene& scene, double tolerance);

}  // namespace mandelmarch
