// SPDX-License-Identifier: Apache-2.0
// Passages: where a path's clearance narrows at least two times and widens again.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "flight/field/field.h"

namespace mandelmarch {

struct Passage {
    std::size_t frame;  // the narrowest
    double clearance;
};

// The field of a frame.
using FieldOf = std::function<const Field&(std::size_t frame)>;

// The passages of a path inside the hull, by the places and clearances of its frames, those that the fractal's symmetry
// maps onto an earlier one left out.
std::vector<Passage> distinct_passages(const FieldOf& field, std::span<const Vector> places,
                                       std::span<const double> clearances);

}  // namespace mandelmarch
