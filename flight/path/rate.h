// SPDX-License-Identifier: Apache-2.0
// The same flight at another rate of frames.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

// How many frames a path at `from` frames a second needs, so that `frames` at `to` a second lie within it.
int frames_at_rate(int frames, int from, int to);

// The flight of `path` in `frames` frames at `rate` a second, which end when its own do at the latest. Places and
// cameras between its frames are those of a cubic spline through them, whose speed and acceleration have no jump; a
// shape that changes is interpolated between two frames. At the path's own rate nothing changes but the number of
// frames. Digits are cut as in a path file.
Path at_rate(const Path& path, int frames, int rate);

}  // namespace mandelmarch
