// SPDX-License-Identifier: Apache-2.0
// The map of a flight, from which a drawing can be made: balls, gates, and the path with its measurements.
#pragma once

#include <string>
#include <vector>

#include "flight/path/path.h"
#include "flight/route/balls.h"

namespace mandelmarch {

// Returns JSON with the bounds of the first frame's shape, and with the balls and gates near the path. A passage is
// given by the number of its narrowest frame. Each frame has its position, its clearance (the distance estimate), and
// its turn since the previous frame in degrees. `threads`: 0 for as many as the process may use.
std::string map_of(const Path& path, const std::vector<Ball>& balls, const std::vector<Ball>& gates, int threads);

}  // namespace mandelmarch
