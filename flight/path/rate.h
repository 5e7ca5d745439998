// SPDX-License-Identifier: Apache-2.0
// The same flight at another rate of frames.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

// The number of frames of a path at `from` frames a second that covers the time of `frames` frames at `to` a second.
int frames_at_rate(int frames, int from, int to);

// The flight of `path` in `frames` frames at `rate` a second; it must not end later than the path. Between the path's
// frames the camera follows a cubic spline through them, whose speed and acceleration have no jumps; a shape that
// changes is interpolated between two frames. If `rate` is the path's, only the number of frames changes. Digits are
// cut as in a path file.
Path at_rate(const Path& path, int frames, int rate);

}  // namespace mandelmarch
