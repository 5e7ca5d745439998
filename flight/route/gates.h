// SPDX-License-Identifier: Apache-2.0
// Gates: narrow places through which a camera can fly from one free space to another. Walls surround most of a gate.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flight/route/balls.h"

namespace mandelmarch {

struct Gate {
    Vector centre;     // the narrowest point of the passage, in the middle of its cross-section
    Vector axis;       // unit vector along the passage
    double clearance;  // the distance estimate at the centre
    double walled;     // fraction of 16 rays across the axis that hit a wall within 7 clearances
    // Two polylines out of the gate. Each begins at the centre and ends at a point inside a ball: the first leads out
    // along +axis, the second along -axis.
    std::array<std::vector<Vector>, 2> ways;
    std::array<int, 2> balls;  // the balls in which the polylines end
    int kind;                  // 0, 1, ...; the same for gates that the fractal's symmetry maps onto each other
};

// Limits of a gate's clearance, and the approximate number of points of Balls::narrows() at which searches start.
struct GateSearch {
    double least, most;
    int tries;
};

// Searches for gates around all points of `also` and around some points of narrows(), which are chosen at random with a
// fixed seed. Returns the `known` gates followed by the new ones.
std::vector<Gate> find_gates(const DistanceField& field, const Balls& balls, const GateSearch& search,
                             std::vector<Gate> known = {}, std::span<const Ball> also = {});

}  // namespace mandelmarch
