// SPDX-License-Identifier: Apache-2.0
// The curve of a flight, and the camera's trajectory: its motion along the curve in time.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "flight/field/field.h"
#include "flight/route/elastic_band.h"

namespace mandelmarch {

// A curve as dense samples. Each vector but `places` has one element per sample.
struct Curve {
    std::vector<Vector> at;
    std::vector<double> length;     // along the curve, from its beginning to the sample
    std::vector<double> clearance;  // the distance estimate
    std::vector<double> slow;       // speed factor: the speed divided by the speed that the clearance allows; at most 1
    std::vector<double> clock;      // shape time, in frames of the schedule
    std::vector<double> value;      // the shape parameter's value at that time
    std::vector<std::size_t> places;  // the samples at which the curve passes the tour's visits
};

// The part of a curve near a place. `first`, `middle` and `last` are samples of the curve: the beginning of the stay,
// the place, and the end of the stay.
struct Stop {
    std::size_t first, middle, last;
    double stay;                  // frames
    std::optional<double> frame;  // frame of the arrival; nullopt: the planner chooses it
    Vector along;                 // unit vector; the gaze during the stay
    double lens;                  // field of view during the stay
    double roll;                  // radians; tilt of the camera during the stay
    // In the time of a trajectory, in frames; set by ride_to_stops().
    double arrives = 0, leaves = 0;
};

// Returns the uniform cubic B-spline whose control points and shape times are given by `line`.
Curve track_of(const Shapes& shapes, const Schedule& schedule, const ControlPoints& line);

// For each frame: the camera's position, and this position as a fractional index into the curve's samples.
struct Trajectory {
    std::vector<Vector> at;
    std::vector<double> sample;
};

// Returns a trajectory along the curve. The speed is at most `pace` clearances per frame and changes gently. The
// trajectory ends after `frames` frames or at the end of the curve.
Trajectory ride(const Bounds& bounds, const Curve& track, double pace, int frames);

struct Timed {
    Trajectory ride;
    double off;  // frames; largest time error at a keyframe or at the last frame
};
// Changes the curve's speed factors so that the camera keeps to the schedule, as far as the pace allows. It keeps to
// the schedule if it is, at each keyframe and at the last of `frames` frames, at the point of the curve whose shape
// time is that frame. Returns the trajectory and its time error.
Timed ride_in_time(const Bounds& bounds, Curve& track, double pace, int frames, const Schedule& schedule);

// Returns the shape time at each of the first `frames` frames of a trajectory made by ride_in_time(). The shape time is
// averaged over three seconds, because otherwise the shape would change as suddenly as the camera's speed. At keyframes
// the shape time is exact.
std::vector<double> clock_of(const Curve& track, const Trajectory& ride, int frames, const Schedule& schedule);

}  // namespace mandelmarch
