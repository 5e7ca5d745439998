// SPDX-License-Identifier: Apache-2.0
// The camera's gaze and roll along its trajectory.
#pragma once

#include <vector>

#include "core/scene/fractal.h"
#include "flight/field/field.h"
#include "flight/path/path.h"
#include "flight/plan/trajectory.h"

namespace mandelmarch {

inline constexpr int look_ahead = 48;  // frames, 1.6 s

// Returns the unit vector from the camera at `frame` to the camera `frames` frames later.
Vector ahead(const Trajectory& ride, std::size_t frame, std::size_t frames);

// Returns the directions of the gaze, one per frame, smoothed in time. The gaze begins at the fractal's centre and
// changes to `aims` over the first three seconds.
std::vector<Vector> smoothed_gaze(const Trajectory& ride, std::vector<Vector> aims);

// Limits turns of the gaze to `most` degrees per frame.
void limit_turns(std::vector<Vector>& gaze, double most);

// Returns one camera per frame. The up vector follows the gaze without roll.
std::vector<Frame> cameras(const Trajectory& ride, const std::vector<Vector>& gaze, Vector up, double field_of_view);

// Rolls the cameras gradually until they are level, by the upward direction that the fractal defines.
void hold_level(std::vector<Frame>& frames, const Fractal& fractal);

// Degrees between two unit vectors.
double degrees_between(Vector a, Vector b);

}  // namespace mandelmarch
