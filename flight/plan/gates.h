// SPDX-License-Identifier: Apache-2.0
// Gates: narrow places that a camera can fly through, with wall most of the way around and free space on both sides.
#pragma once

#include <array>
#include <span>
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

// Bounds of a gate's clearance, and how many of the balls' narrow places gates are searched from, about.
struct GateSearch {
    double least, most;
    int tries;
};

// The gates that are `known` stay, and come first. More are searched from the places `also`, too.
std::vector<Gate> find_gates(const Field& field, const Balls& balls, const GateSearch& search,
                             std::vector<Gate> known = {}, std::span<const Ball> also = {});

}  // namespace mandelmarch
