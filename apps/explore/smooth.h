// SPDX-License-Identifier: Apache-2.0
// Turns a recorded flight into one that is suitable for a film.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch::explore {

// Returns the camera between two frames, with the scene changes of the nearer one.
Frame between(const Frame& a, const Frame& b, double share);

// Returns the path smoothed, where there is room between walls, and slower where a step or a turn exceeds the audit's
// promises. The number of frames may grow.
Path smoothed(const Path& path);

// Returns the path with the camera of `frame` at frame number `at`; cameras around it are moved accordingly.
Path bent(Path path, std::size_t at, const Frame& frame);

}  // namespace mandelmarch::explore
