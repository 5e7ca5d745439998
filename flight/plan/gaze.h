// SPDX-License-Identifier: Apache-2.0
// Where the camera looks on its ride.
#pragma once

#include <vector>

#include "core/scene/fractal.h"
#include "flight/field/field.h"
#include "flight/path/path.h"
#include "flight/plan/ride.h"

namespace mandelmarch {

inline constexpr int look_ahead = 48;  // frames, 1.6 s

// The unit vector from a frame's place to where the camera will be so many frames later.
Vector ahead(const Ride& ride, std::size_t frame, std::size_t frames);

// Directions of the gaze, one a frame, smoothed in time; the first three seconds leave the fractal's middle.
std::vector<Vector> smoothed_gaze(const Ride& ride, std::vector<Vector> aims);

// The same with no turn of more than `most` degrees from frame to frame.
void limit_turns(std::vector<Vector>& gaze, double most);

// The cameras: the up vector is carried along without rolling.
std::vector<Frame> cameras(const Ride& ride, const std::vector<Vector>& gaze, Vector up, double field_of_view);

// Rolls the cameras of a path's frames bit by bit to where their fractal shows upwards what is up.
void hold_level(std::vector<Frame>& frames, const Fractal& fractal);

// Degrees between two unit vectors.
double degrees_between(Vector a, Vector b);

}  // namespace mandelmarch
