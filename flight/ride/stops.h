// SPDX-License-Identifier: Apache-2.0
// Stops: the places of a places file on a tour's curve, and in the time of a trajectory.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "flight/path/places.h"
#include "flight/route/tour.h"
#include "flight/ride/trajectory.h"

namespace mandelmarch {

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

// Returns a message about the first stop that is not met: the camera is too early or too late, or does not look in the
// stop's direction. Returns "" if all stops are met. `gaze`: one unit vector per frame.
std::string missed_stop(const Places& places, std::span<const Stop> stops, std::span<const Vector> gaze);

}  // namespace mandelmarch
