// SPDX-License-Identifier: Apache-2.0
// The direction of a film's sun.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

// Returns the unit vector towards the sun for a path's film. The sun is as high as the default sun of Scene. Its
// horizontal direction is chosen so that most frames are lit from the side, which shows relief best, and rather from
// behind the camera than from the front.
Vector sun_of(const Path& path);

}  // namespace mandelmarch
