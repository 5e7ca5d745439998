// SPDX-License-Identifier: Apache-2.0
// What a flight looks like, for people who draw it: the free balls, the gates, and the path with what was measured on
// it.
#pragma once

#include <string>
#include <vector>

#include "flight/path/path.h"
#include "flight/plan/balls.h"

namespace mandelmarch {

// JSON: hull, the balls and gates on and beside the path, passages (frames), and for each frame its place, clearance
// (the distance estimate) and turn since the frame before in degrees. The hull is that of the first frame's shape;
// `threads`: 0 for one a core.
std::string map_of(const Path& path, const std::vector<Ball>& balls, const std::vector<Ball>& gates, int threads);

}  // namespace mandelmarch
