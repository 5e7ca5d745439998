// SPDX-License-Identifier: Apache-2.0
// Turns, jerk and roll of the camera.
#pragma once

#include <span>
#include <vector>

#include "flight/audit/audit.h"

namespace mandelmarch {

// Returns, for each frame, the angle in degrees by which the camera has rotated since the previous frame, including
// roll; 0 for the first frame.
std::vector<double> turns_of(const Path& path);

// Returns the 95th percentiles of the jerk (third differences of the position, in clearances / s^3) and of the angular
// jerk (second differences of the rotation between frames, in degrees / s^3). `clearances`: one per frame.
std::vector<Row> jerk_rows(const Path& path, std::span<const double> clearances);

// Returns the percentage of frames that are within 30 degrees of level. Only frames whose gaze is at least 30 degrees
// from vertical count.
Row level_row(const Path& path);

}  // namespace mandelmarch
