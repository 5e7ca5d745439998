// SPDX-License-Identifier: Apache-2.0
// Smooths a polyline inside the free space by an elastic band.
#pragma once

#include "flight/field/shapes.h"
#include "flight/plan/schedule.h"
#include "flight/plan/tour.h"

namespace mandelmarch {

// The control points of a curve, with the shape time (in frames of the schedule) and the shape parameter's value at
// each point.
struct ControlPoints {
    std::vector<Vector> at;
    std::vector<double> clock, value;
};

// Returns the smallest estimate on a polyline after every point has been moved with the walls to the shape at its own
// time, before smoothing. `step` is that of smooth().
double least_on(const Shapes& shapes, const Polyline& way, const Schedule& schedule, double step);

// Returns a smooth version of a polyline by an elastic band (Quinlan and Khatib). The band's points are about a third
// of their clearance apart. It is pulled straight and away from walls, while each point stays in a ball around its
// position and pins barely move. `least`: the smallest estimate that a point may move to. If the shape changes, the
// polyline is first moved with the walls from the shapes in which it was found to the shape at each point's own time,
// and that time is smoothed. `step`: the change of the shape parameter that moves walls by half the smallest clearance
// of a roadmap.
ControlPoints smooth(const Shapes& shapes, const Polyline& way, const Schedule& schedule, double step, double least);

}  // namespace mandelmarch
