// SPDX-License-Identifier: Apache-2.0
// Gates: narrow places that a camera can fly through, with wall most of the way around and free space on both sides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flight/plan/balls.h"

namespace mandelmarch {

struct Gate {
    Vector centre;     // the narrowest point, in the middle of its narrows
    Vector axis;       // unit vector along the way through
    double clearance;  // the distance estimate at the centre
    double walled;     // share of 16 rays across the axis that meet wall within 7 clearances
    // The ways out, from the centre along +axis and -axis to a point that a ball holds.
    std::array<std::vector<Vector>, 2> ways;
    std::array<int, 2> balls;
    int kind;  // gates that the fractal's symmetry maps onto each other have the same kind, 0 and up
};

// Searched from up to `tries` of the balls' narrow places. `least` and `most`: bounds of a gate's clearance.
std::vector<Gate> find_gates(const Field& field, const Balls& balls, double least, double most, int tries);

}  // namespace mandelmarch
