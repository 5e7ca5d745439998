// SPDX-License-Identifier: Apache-2.0
// Along the smoothed way in time: a smooth curve, and how fast it is flown.
#pragma once

#include <vector>

#include "flight/field/field.h"

namespace mandelmarch {

// A curve as dense samples.
struct Track {
    std::vector<Vector> at;
    std::vector<double> length;     // from the beginning, along the curve
    std::vector<double> clearance;  // the distance estimate
    std::vector<double> slow;       // 1, or less where the speed must be less than the clearance allows
};

// The uniform cubic B-spline of the points.
Track track_of(const Field& field, const std::vector<Vector>& points);

// Where the camera is at each frame, and the sample of the track it has reached.
struct Ride {
    std::vector<Vector> at;
    std::vector<double> sample;
};

// Flies the track with at most `pace` clearances a frame, changing speed gently. Ends after `frames` frames or where
// the track ends.
Ride ride(const Field& field, const Track& track, double pace, int frames);

}  // namespace mandelmarch
