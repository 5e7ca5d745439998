// SPDX-License-Identifier: Apache-2.0
// A tour: through which gates, in which order, and a first rough way through the balls between them.
#pragma once

#include <vector>

#include "flight/plan/gates.h"
#include "flight/plan/random.h"

namespace mandelmarch {

// A polyline whose pins must be kept: the gates' centres.
struct Way {
    std::vector<Vector> points;
    std::vector<char> pinned;  // one a point
};

struct Tour {
    Way way;
    int gates = 0;
    double cost = 0;  // of the whole way, in clearances
};

// Distances count in clearances, as that is how the camera's speed goes: the integral of ds / min(clearance, cap).
// 0.1 hull sizes: beyond it a wider space is flown through no faster.
double fastest_clearance(const Hull& hull);

// Flies from outside from gate to gate, never twice through gates that look the same, until `budget` is spent or no
// gate is left in reach. `random` draws the start and, among the next gates, not always the nearest.
Tour make_tour(const Field& field, const Balls& balls, const std::vector<Gate>& gates, double budget, Random& random);

}  // namespace mandelmarch
