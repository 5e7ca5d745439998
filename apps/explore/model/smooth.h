// SPDX-License-Identifier: Apache-2.0
// Changes a recorded flight so that it is suitable for a film.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch::explore {

// Returns a frame whose camera lies between the cameras of `a` (share 0) and `b` (share 1). Its changes to the scene
// are those of the closer frame.
Frame between(const Frame& a, const Frame& b, double share);

// Returns a smoothed path. If smoothing would bring a camera too close to walls, the camera is moved less. Where a step
// or a turn would come close to the audit's limit, frames are added, which makes the flight slower.
Path smoothed(const Path& path);

}  // namespace mandelmarch::explore
