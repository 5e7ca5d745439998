// SPDX-License-Identifier: Apache-2.0
// Adapts the speed and the beginning of a flight to what its camera sees, and to the places that it visits. Stops are
// these places on a tour's curve, and in the time of a trajectory.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "flight/path/places.h"
#include "flight/ride/director.h"
#include "flight/ride/trajectory.h"
#include "flight/route/tour.h"

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

// Returns the largest distance from a place during a stay, three quarters of a clearance, in the scene's units.
// `clearance`: that of the place.
double reach_at(const Bounds& bounds, double clearance);

// Returns the stops at the curve's places. During a stay, the camera is within three quarters of a clearance of the
// place.
std::vector<Stop> stops_of(const Bounds& bounds, const Curve& track, const Places& places,
                           std::span<const Visit> visits);

// Changes the curve's speed factors so that the camera arrives at the stops in time and stays there, as far as the pace
// allows. Returns the trajectory, which has up to 3 * `frames` frames, and its largest time error.
Timed ride_to_stops(const Bounds& bounds, Curve& track, double pace, int frames, std::span<Stop> stops);

// Turns the gaze gradually to the stops' directions, and keeps it there during the stays.
void hold_gaze(std::vector<Vector>& gaze, std::span<const Stop> stops);

// Changes the field of view gradually to those of the stops. Returns the tilt that each frame should have, see Tilt.
std::vector<double> hold_lens(std::vector<Frame>& frames, std::span<const Stop> stops);

// Returns a message about the first stop that is not met: the camera is too early or too late, or does not look in the
// stop's direction. Returns "" if all stops are met. `gaze`: one unit vector per frame.
std::string missed_stop(const Places& places, std::span<const Stop> stops, std::span<const Vector> gaze);

}  // namespace mandelmarch
