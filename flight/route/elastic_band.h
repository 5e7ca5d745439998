// SPDX-License-Identifier: Apache-2.0
// Smooths a polyline in free space by an elastic band.
#pragma once

#include "flight/field/field.h"
#include "flight/route/schedule.h"
#include "flight/route/tour.h"

namespace mandelmarch {

// The control points of a curve. When the camera is at a point, the fractal has the shape that the schedule gives for
// the point's shape time.
struct ControlPoints {
    std::vector<Vector> at;
    std::vector<double> clock;        // shape time, in frames of the schedule
    std::vector<std::size_t> places;  // indices of the points whose Pin is `place`
};

// Returns the smallest estimate on a polyline after its points have been moved with the walls, as smooth() moves them,
// but before they are smoothed. `step`: see smooth().
double least_on(const Shapes& shapes, const Polyline& way, const Schedule& schedule, double step);

// Returns a smooth version of a polyline by an elastic band (Quinlan and Khatib). The band's points are about a third
// of their clearance apart. In each round the band is pushed away from walls and pulled straight; each point stays in a
// ball around its position, gates barely move, and points of a visit do not move. `least`: no other point moves to a
// place with a smaller estimate.
// If the shape changes in flight, the polyline is first moved with the walls. For each point, the shape changes from
// the one in which the point was found to the one at the point's shape time. The shape time is smoothed as well.
// `step`: the change of the shape parameter that moves walls by half the smallest clearance of a roadmap.
ControlPoints smooth(const Shapes& shapes, const Polyline& way, const Schedule& schedule, double step, double least);

}  // namespace mandelmarch
