// SPDX-License-Identifier: Apache-2.0
// The camera's gaze and roll along its trajectory.
#pragma once

#include <cmath>
#include <vector>

#include "core/scene/fractal.h"
#include "flight/path/path.h"
#include "flight/ride/trajectory.h"

namespace mandelmarch {

inline constexpr int look_ahead = 48;  // frames (1.6 s); the gaze at a frame follows the motion over this time

// Returns the unit vector from the camera's position at `frame` to its position `frames` frames later.
Vector ahead(const Trajectory& ride, std::size_t frame, std::size_t frames);

// Returns the gaze smoothed in time. `aims`: the gaze before smoothing, a unit vector per frame. At the first frame the
// camera looks at the fractal's centre; within three seconds the gaze changes to `aims`. `from_outside`: false if the
// gaze is `aims` from the first frame.
std::vector<Vector> smoothed_gaze(const Trajectory& ride, std::vector<Vector> aims, bool from_outside = true);

// Limits turns of the gaze to `most` degrees per frame.
void limit_turns(std::vector<Vector>& gaze, double most);

// Returns an up vector for a gaze: the y axis, or the z axis if the camera looks within about 45 degrees of the y axis.
inline Vector first_up(Vector gaze) { return std::abs(gaze.y) < 0.7 ? Vector{0, 1, 0} : Vector{0, 0, 1}; }

// Returns one camera per frame. `up`: the first camera's up vector; the others follow from it without roll.
std::vector<Frame> cameras(const Trajectory& ride, const std::vector<Vector>& gaze, Vector up, double field_of_view);

// Rolls the cameras gradually until they have these tilts or, without tilts, are level. The fractal defines which
// direction is upward.
void hold_level(std::vector<Frame>& frames, const Fractal& fractal, const std::vector<double>& tilts = {});

// Returns the angle between two unit vectors in degrees.
double degrees_between(Vector a, Vector b);

}  // namespace mandelmarch
