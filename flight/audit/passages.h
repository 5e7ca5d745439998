// SPDX-License-Identifier: Apache-2.0
// Passages: places at which a path's clearance falls to half or less and then becomes at least twice as large again.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "flight/field/field.h"

namespace mandelmarch {

struct Passage {
    std::size_t frame;  // the passage's frame with the smallest clearance
    double clearance;
};

// A function that returns the distance field of a frame.
using FieldOf = std::function<const DistanceField&(std::size_t frame)>;

// Returns the passages inside the bounds, from the positions and clearances of a path's frames. A passage that the
// fractal's symmetry maps onto an earlier one is left out.
std::vector<Passage> distinct_passages(const FieldOf& field, std::span<const Vector> places,
                                       std::span<const double> clearances);

}  // namespace mandelmarch
