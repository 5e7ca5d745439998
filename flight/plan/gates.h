// SPDX-License-Identifier: Apache-2.0
// Gates: narrow places that a camera can fly through, mostly surrounded by wall, with free space on both sides.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flight/plan/balls.h"

namespace mandelmarch {

struct Gate {
    Vector centre;     // the narrowest point of the passage, in the middle of its cross-section
    Vector axis;       // unit vector along the passage
    double clearance;  // the distance estimate at the centre
    double walled;     // fraction of 16 rays across the axis that hit a wall within 7 clearances
    // Polylines out of the gate, from the centre along +axis and -axis to a point inside a ball.
    std::array<std::vector<Vector>, 2> ways;
    std::array<int, 2> balls;
    int kind;  // gates that the fractal's symmetry maps onto each other have the same kind, 0 and up
};

// Limits of a gate's clearance, and the approximate number of points of Balls::narrows() at which a search starts.
struct GateSearch {
    double least, most;
    int tries;
};

// Returns the `known` gates, then those found from points of narrows(), chosen at random with a fixed seed, and from
// all points of `also`.
std::vector<Gate> find_gates(const DistanceField& field, const Balls& balls, const GateSearch& search,
                             std::vector<Gate> known = {}, std::span<const Ball> also = {});

}  // namespace mandelmarch
