// SPDX-License-Identifier: Apache-2.0
// Where a film's sun stands.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

// A unit vector towards the sun that suits a path: as high as Scene's, in the direction from which it lights most of
// what the frames look at from the side, which shows relief best, and rather from behind the camera than against it.
Vector sun_of(const Path& path);

}  // namespace mandelmarch
