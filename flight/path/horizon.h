// SPDX-License-Identifier: Apache-2.0
// The camera's roll relative to a level horizon, for fractals that have an up and a down.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

struct Tilt {
    double angle;    // roll in radians about the gaze (right-hand rule) that makes the frame level: -pi to pi
    double horizon;  // 1: a horizon crosses the picture's centre, 0: the gaze is vertical and level is undefined
};

// Returns the tilt of a frame if `upward`, a unit vector, points upwards.
Tilt tilt_of(const Frame& frame, Vector upward);
// The same with the upward direction that the fractal defines at the frame's eye.
Tilt tilt_of(const Frame& frame, const Fractal& fractal);

// Returns the frame with its camera rolled about its gaze by `angle` radians.
Frame rolled(Frame frame, double angle);

}  // namespace mandelmarch
