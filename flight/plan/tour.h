// SPDX-License-Identifier: Apache-2.0
// A tour: through which gates, in which order, and a first rough way through the balls between them.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "flight/plan/random.h"
#include "flight/plan/roads.h"

namespace mandelmarch {

// A polyline whose pins must be kept: the gates' centres.
struct Way {
    std::vector<Vector> points;
    std::vector<char> pinned;  // one a point
    // Of each point: where the clock stands, in frames, and the shape number of the roads that it was found on.
    std::vector<double> clock, found;
};

struct Tour {
    Way way;
    int gates = 0;
    double cost = 0;   // of the whole way, in clearances
    double clock = 0;  // at its end, frames
};

// What ends a tour: its cost, in clearances, or its clock, in frames, where the shape changes.
struct TourLength {
    double cost = std::numeric_limits<double>::infinity();
    double clock = std::numeric_limits<double>::infinity();
    double frames_a_clearance = 0;  // how the clock goes: 1 / (clearances a frame)
};

// Flies from outside from gate to gate, never twice through gates that look the same, until its length is spent or no
// gate is left in reach; with a clock it flies on to wide places where there is no gate. `random` draws the start and,
// among the next gates, not always the nearest. Each stretch is searched on its own roads: where the clock passes its
// end, the way goes on in the ball of the next roads that holds the place.
// `fine`: asked of each part of the way in turn, which begins with the last points before; what it refuses is not
// flown.
Tour make_tour(std::span<const Stretch> stretches, const TourLength& length, Random& random,
               const std::function<bool(const Way& part)>& fine = {});

}  // namespace mandelmarch
