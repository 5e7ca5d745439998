// SPDX-License-Identifier: Apache-2.0
// Where the camera looks on its ride.
#pragma once

#include <vector>

#include "flight/field/field.h"
#include "flight/path/path.h"
#include "flight/plan/ride.h"

namespace mandelmarch {

inline constexpr int look_ahead = 48;  // frames, 1.6 s

// Unit vectors for the first `frames` places of a ride that goes on for look_ahead more: towards where the camera will
// be, tilted by `tilt` (one a frame, added to the unit vector), smoothed in time. The first frames look at the middle
// of the fractal.
std::vector<Vector> gaze(const Ride& ride, const std::vector<Vector>& tilt, int frames);

// The same with no turn of more than `most` degrees from frame to frame.
void limit_turns(std::vector<Vector>& gaze, double most);

// The cameras: the up vector is carried along without rolling.
std::vector<Frame> cameras(const Ride& ride, const std::vector<Vector>& gaze, Vector up, double field_of_view);

// Degrees between two unit vectors.
double degrees_between(Vector a, Vector b);

}  // namespace mandelmarch
