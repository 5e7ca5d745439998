// SPDX-License-Identifier: Apache-2.0
// Changes a recorded flight so that it is suitable for a film.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch::explore {

// Returns the camera between two frames: that of `a` for share 0, that of `b` for share 1. The changes to the scene are
// those of the closer frame.
Frame between(const Frame& a, const Frame& b, double share);

// Returns a smoothed path. A camera moves less if walls leave it too little room. Where a step or a turn would come
// close to the audit's limit, frames are added, so that the flight is slower.
Path smoothed(const Path& path);

// Returns the path with the camera of `frame` at frame number `at`. The cameras of 45 frames on either side move along,
// the less the farther they are.
Path bent(Path path, std::size_t at, const Frame& frame);

}  // namespace mandelmarch::explore
