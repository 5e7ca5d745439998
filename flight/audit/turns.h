// SPDX-License-Identifier: Apache-2.0
// How the camera turns and how smoothly it goes.
#pragma once

#include <span>
#include <vector>

#include "flight/audit/audit.h"

namespace mandelmarch {

// Of each frame: the angle in degrees of the rotation, roll included, from the camera of the frame before; 0 of the
// first.
std::vector<double> turns_of(const Path& path);

// The 95th percentiles of the jerk of the place (third differences, in clearances a second^3) and of the angular jerk
// (second differences of the rotation between frames, in degrees a second^3). `clearances`: one a frame.
std::vector<Row> jerk_rows(const Path& path, std::span<const double> clearances);

// Of the frames in whose pictures there is a horizon: how many are held level.
Row level_row(const Path& path);

}  // namespace mandelmarch
