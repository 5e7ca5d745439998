// SPDX-License-Identifier: Apache-2.0
// A tour: a sequence of gates, and a polyline through them and the balls in between.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "flight/plan/random.h"
#include "flight/plan/roadmap.h"

namespace mandelmarch {

// A polyline; its pinned points, the gates' centres, must be kept.
struct Polyline {
    std::vector<Vector> points;
    std::vector<char> pinned;  // for each point
    // For each point: its shape time in frames, and the shape parameter's value of the roadmap that it was found on.
    std::vector<double> clock, found;
};

struct Tour {
    Polyline way;
    int gates = 0;
    double cost = 0;   // in clearances
    double clock = 0;  // shape time at the end, frames
};

// The length at which a tour ends: its cost in clearances or, if the shape changes, its shape time in frames.
struct TourLength {
    double cost = std::numeric_limits<double>::infinity();
    double clock = std::numeric_limits<double>::infinity();
    double frames_a_clearance = 0;  // shape time per distance: 1 / (clearances per frame)
};

// Returns a tour that starts outside and leads from gate to gate until the length is reached or no gate is in reach. It
// passes gates that look the same only once, unless no other gate is left. If the length is a shape time, it leads to
// other places inside when no gate is in reach. `random` chooses the start and influences the choice of each gate.
// Each stretch uses its own roadmap. When the shape time passes its end, the tour continues in the next roadmap's ball
// at the same place.
// `fine`: if given, called for each new part of the tour, together with up to four points before it; a part for which
// it returns false is discarded.
Tour make_tour(std::span<const RoadmapSpan> stretches, const TourLength& length, FlightRandom& random,
               const std::function<bool(const Polyline& part)>& fine = {});

}  // namespace mandelmarch
