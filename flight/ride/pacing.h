// SPDX-License-Identifier: Apache-2.0
// Adapts the speed and the beginning of a flight to what its camera sees.
#pragma once

#include <vector>

#include "flight/ride/director.h"
#include "flight/ride/trajectory.h"

namespace mandelmarch {

// Reduces the curve's speed factors at places at which the gaze turns too fast. `views`: the gaze, a unit vector per
// frame.
void slow_turns(Curve& track, const Trajectory& ride, const std::vector<Vector>& views);

// Changes the curve's speed factors so that the median motion of the pixels approaches 0.014 picture heights per frame.
// No factor exceeds 1. `frames`: the cameras of the trajectory.
void keep_moving(Curve& track, const Trajectory& ride, const std::vector<Frame>& frames, const Director& director);

// Returns ride() without its first `skip` frames. If it then has fewer than `frames` frames, skips fewer frames, and
// sets `skip` to their number.
Trajectory ride_without(const Bounds& bounds, const Curve& track, double pace, int frames, int& skip);

// Returns the number of frames to skip at the beginning so that at most 8 % of the frames are outside the bounds. The
// number is at most 6 % of the frames, even if more would have to be skipped. `skip`: the number of frames that the
// trajectory skips already.
int shortened_by(const Bounds& bounds, const Trajectory& ride, int frames, int skip);

// Changes a flight of `frames` frames so that the camera starts from rest and comes to rest, each within two seconds or
// a fortieth of the flight. The frames behind the last one move on.
void ease_ends(Trajectory& ride, int frames);

}  // namespace mandelmarch
