// SPDX-License-Identifier: Apache-2.0
// How level a camera is held, where its place has an up and a down.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch {

struct Tilt {
    double angle;    // radians about the gaze, by the right hand's rule, that make the frame level: -pi to pi
    double horizon;  // 1: a horizon crosses the picture's middle, 0: the gaze is straight up or down, and none is level
};

// Of a frame, where upwards is the unit vector `upward`.
Tilt tilt_of(const Frame& frame, Vector upward);
// Where it is as the fractal says of the frame's place.
Tilt tilt_of(const Frame& frame, const Fractal& fractal);

// The frame's camera rolled about its gaze, by radians.
Frame rolled(Frame frame, double angle);

}  // namespace mandelmarch
