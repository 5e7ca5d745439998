// SPDX-License-Identifier: Apache-2.0
// A tour: a polyline that leads through a sequence of gates and through the balls between them.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "flight/plan/random.h"
#include "flight/plan/roadmap.h"

namespace mandelmarch {

// A polyline. Its pinned points, which are the centres of gates, must be kept when it is smoothed.
struct Polyline {
    std::vector<Vector> points;
    std::vector<char> pinned;   // for each point
    std::vector<double> clock;  // for each point: its shape time in frames
    std::vector<double> found;  // for each point: the shape parameter of the roadmap that contains it
};

struct Tour {
    Polyline way;
    int gates = 0;
    double cost = 0;   // of the whole tour, in clearances
    double clock = 0;  // shape time at the tour's end, in frames
};

// The length at which a tour ends: a cost in clearances or, if the shape changes, a shape time in frames.
struct TourLength {
    double cost = std::numeric_limits<double>::infinity();
    double clock = std::numeric_limits<double>::infinity();
    double frames_a_clearance = 0;  // shape time that passes on a way of one clearance, in frames
};

// Returns a tour that starts outside the fractal and leads from gate to gate. It ends when it reaches the length. If no
// gate is in reach, it ends as well or, if the length is a shape time, leads to another place inside. The tour passes
// gates of the same kind only once, as long as gates of other kinds are in reach. `random` chooses the start and
// influences the choice of each gate. Each stretch of time uses its own roadmap. When the shape time passes the end of
// a stretch, the tour continues in a ball of the next roadmap at the same place. `fine` is called, if given, with each
// new part of the tour, preceded by up to four older points. A part for which `fine` returns false is discarded.
Tour make_tour(std::span<const RoadmapSpan> stretches, const TourLength& length, FlightRandom& random,
               const std::function<bool(const Polyline& part)>& fine = {});

}  // namespace mandelmarch
