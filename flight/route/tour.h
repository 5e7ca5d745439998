// SPDX-License-Identifier: Apache-2.0
// A tour: a polyline that leads through a sequence of gates and through the balls between them.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "flight/route/random.h"
#include "flight/route/roadmap.h"

namespace mandelmarch {

// A point's role when a polyline is smoothed. `gate`: the centre of a gate, which is kept and barely moves. `place`: a
// place that the tour visits. `beside`: a point in front of such a place or behind it. Both are kept and do not move.
enum class Pin : char { none, gate, beside, place };

struct WayPoint {
    Vector at;
    Pin pin;
    double clock;  // shape time in frames
    double found;  // the shape parameter of the roadmap that contains the point
};
using Polyline = std::vector<WayPoint>;

struct Tour {
    Polyline way;
    int gates = 0;
    double cost = 0;   // cost of the whole tour, in clearances, with penalties
    double flown = 0;  // length in clearances, without penalties
    double clock = 0;  // shape time at the tour's end, in frames
};

// A place that a tour visits.
struct Visit {
    Vector place;
    Vector along;          // unit vector; the tour passes the place in this direction, on a straight line ...
    double before, after;  // ... that begins and ends at these distances from the place
    int ball;              // a ball with a free way to the place
    bool starts;           // true: the tour starts at the place
    int gates;             // largest number of gates on the way to the place
    double longest;        // clearances; gates are left out if the way to the place would be longer
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
// `visits`: places that the tour visits first, in this order; only for a shape that does not change. At least one gate
// follows them.
Tour make_tour(std::span<const RoadmapSpan> stretches, const TourLength& length, FlightRandom& random,
               const std::function<bool(const Polyline& part)>& fine = {}, std::span<const Visit> visits = {});

}  // namespace mandelmarch
