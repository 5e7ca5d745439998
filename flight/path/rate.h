// SPDX-License-Identifier: Apache-2.0
// Conversion of a path to another frame rate.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

// Returns how many frames at `from` frames per second cover the time of `frames` frames at `to` frames per second.
int frames_at_rate(int frames, int from, int to);

// Returns the flight of `path` as `frames` frames at `rate` frames per second. It must not last longer than the path.
// The camera follows a cubic spline through the path's frames, so that its speed and acceleration are continuous. A
// changing shape is interpolated linearly between two frames. Camera numbers are rounded as in a path file. If `rate`
// is the path's rate, only the number of frames changes.
Path at_rate(const Path& path, int frames, int rate);

}  // namespace mandelmarch
