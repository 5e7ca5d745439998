// SPDX-License-Identifier: Apache-2.0
// The direction of a film's sun.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

// Returns a unit vector towards the sun for a path. Its height is that of Scene's sun. Its direction is chosen so that
// most frames are lit from the side, which shows relief best, and from behind the camera rather than against it.
Vector sun_of(const Path& path);

}  // namespace mandelmarch
