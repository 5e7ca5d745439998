// SPDX-License-Identifier: Apache-2.0
// Smooths a rough way inside the free space.
#pragma once

#include "flight/field/shapes.h"
#include "flight/plan/schedule.h"
#include "flight/plan/tour.h"

namespace mandelmarch {

// The points of a curve; where the clock stands there, in frames of the schedule, and the shape number that the fractal
// has then.
struct Line {
    std::vector<Vector> at;
    std::vector<double> clock, value;
};

// The least estimate on a way when it has followed the walls to the shapes of its moments, as it will be before it is
// smoothed.
double least_on(const Shapes& shapes, const Way& way, const Schedule& schedule, double step);

// An elastic band of points at distances of about a third of their clearance: it is drawn straight and away from walls,
// while each point stays in a ball around its place and the pins stay where they are. `least`: no point goes where the
// distance estimate is less. Every point is in the shape of its own moment: where the schedule changes, the way follows
// the walls from the shapes that it was found in, and its clock becomes smooth. `step`: by so much of the number walls
// move by half a road's least clearance.
Line smooth(const Shapes& shapes, const Way& way, const Schedule& schedule, double step, double least);

}  // namespace mandelmarch
