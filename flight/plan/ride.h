// SPDX-License-Identifier: Apache-2.0
// Along the smoothed way in time: a smooth curve, and how fast it is flown.
#pragma once

#include <vector>

#include "flight/field/shapes.h"
#include "flight/plan/band.h"

namespace mandelmarch {

// A curve as dense samples.
struct Track {
    std::vector<Vector> at;
    std::vector<double> length;     // from the beginning, along the curve
    std::vector<double> clearance;  // the distance estimate
    std::vector<double> slow;       // 1, or less where the speed must be less than the clearance allows
    std::vector<double> clock;      // in frames of the schedule
    std::vector<double> value;      // the shape number that the fractal has there
};

// The uniform cubic B-spline of the line's points, clock and all.
Track track_of(const Shapes& shapes, const Schedule& schedule, const Line& line);

// Where the camera is at each frame, and the sample of the track it has reached.
struct Ride {
    std::vector<Vector> at;
    std::vector<double> sample;
};

// Flies the track with at most `pace` clearances a frame, changing speed gently. Ends after `frames` frames or where
// the track ends.
Ride ride(const Hull& hull, const Track& track, double pace, int frames);

// Changes `slow` so that the camera comes to the places of the schedule's knots, and of the last of `frames` frames, at
// their frames, as nearly as it may without going faster than the pace; returns the ride, and by how many frames it
// misses the worst of them.
struct Timed {
    Ride ride;
    double off;
};
Timed ride_in_time(const Hull& hull, Track& track, double pace, int frames, const Schedule& schedule);

// Where the clock stands at each of the first `frames` frames of a ride in time. It is even, the mean over three
// seconds, so that the shape does not change as suddenly as clearances do, and right at the schedule's knots.
std::vector<double> clock_of(const Track& track, const Ride& ride, int frames, const Schedule& schedule);

}  // namespace mandelmarch
