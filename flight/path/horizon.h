// SPDX-License-Identifier: Apache-2.0
// The camera's roll relative to a level horizon, for fractals that have an up and a down.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

struct Tilt {
    double angle;    // rolling the frame by this angle makes it level; radians, -pi to pi, see rolled()
    double horizon;  // squared sine of the angle between gaze and vertical; 0: vertical gaze, `angle` is undefined
};

// Returns the tilt of a frame. `upward`: the unit vector that counts as upward.
Tilt tilt_of(const Frame& frame, Vector upward);
// Returns the tilt of a frame, with the upward direction that the fractal defines at the frame's eye.
Tilt tilt_of(const Frame& frame, const Fractal& fractal);

// Returns the frame with its camera rolled about its gaze by `angle` radians (right-hand rule).
Frame rolled(Frame frame, double angle);

}  // namespace mandelmarch
