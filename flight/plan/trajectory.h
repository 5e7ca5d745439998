// SPDX-License-Identifier: Apache-2.0
// The curve of a flight, and the camera's trajectory along it in time.
#pragma once

#include <vector>

#include "flight/field/shapes.h"
#include "flight/plan/elastic_band.h"

namespace mandelmarch {

// A curve as dense samples; vectors have one element per sample.
struct Curve {
    std::vector<Vector> at;
    std::vector<double> length;     // from the beginning, along the curve
    std::vector<double> clearance;  // the distance estimate
    std::vector<double> slow;       // speed factor, at most 1, on the speed that the clearance allows
    std::vector<double> clock;      // shape time, in frames of the schedule
    std::vector<double> value;      // the shape parameter's value at that time
};

// Returns the uniform cubic B-spline of the line's points and shape times.
Curve track_of(const Shapes& shapes, const Schedule& schedule, const ControlPoints& line);

// The camera's position at each frame, and the (fractional) index of the curve's sample there.
struct Trajectory {
    std::vector<Vector> at;
    std::vector<double> sample;
};

// Returns a trajectory along the curve with gentle changes of speed and at most `pace` clearances per frame. It ends
// after `frames` frames or at the end of the curve.
Trajectory ride(const Bounds& bounds, const Curve& track, double pace, int frames);

// A trajectory, and its largest time error at a keyframe in frames.
struct Timed {
    Trajectory ride;
    double off;
};
// Changes the curve's speed factors so that the camera reaches the points of the schedule's keyframes, and of the last
// of `frames` frames, on time, as far as the pace allows.
Timed ride_in_time(const Bounds& bounds, Curve& track, double pace, int frames, const Schedule& schedule);

// Returns the shape time at each of the first `frames` frames of a trajectory by ride_in_time(). It is averaged over
// three seconds, so that the shape does not change as suddenly as clearances do, and exact at the keyframes.
std::vector<double> clock_of(const Curve& track, const Trajectory& ride, int frames, const Schedule& schedule);

}  // namespace mandelmarch
