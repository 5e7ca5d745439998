// SPDX-License-Identifier: Apache-2.0
// Conversion of a path to another frame rate.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

// Returns the number of frames at `from` frames per second that cover the time of `frames` frames at `to` per second.
int frames_at_rate(int frames, int from, int to);

// Returns the flight of `path` in `frames` frames at `rate` frames per second; it must not end later than the path. The
// camera follows a cubic spline (continuous speed and acceleration) through the path's frames; a changing shape is
// interpolated linearly between two frames. If `rate` is the path's, only the number of frames changes. Numbers are
// rounded as in a path file.
Path at_rate(const Path& path, int frames, int rate);

}  // namespace mandelmarch
