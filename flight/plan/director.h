// SPDX-License-Identifier: Apache-2.0
// Chooses over time where the camera looks: of all ways that a gaze can go, the one with most to see.
#pragma once

#include <span>
#include <vector>

#include "flight/field/shapes.h"
#include "flight/path/path.h"
#include "flight/plan/ride.h"

namespace mandelmarch {

// What there is to see along a track: panoramas at places of it, and what each direction is worth as a gaze.
class Director {
public:
    Director(const Shapes& shapes, const Track& track);

    // Unit vectors for the first `frames` places, two at least, of a ride along the track that goes on for look_ahead
    // more. Dynamic programming (Bellman) over directions at every tenth frame: a direction costs what its view lacks,
    // how far it is off the motion, and the turn to it. smoothed_gaze() smooths them.
    std::vector<Vector> gaze(const Ride& ride, int frames) const;

    // How far a gaze's picture moves from one frame to the next, as median_motion of a view: by the panorama at a
    // sample of the track.
    double motion(double sample, const Frame& from, const Frame& to) const;

private:
    static void rate(std::span<const float> depths, double clearance, std::span<float> costs);
    std::size_t panorama_at(double sample) const;

    std::vector<double> samples_;  // of the track, one a panorama
    std::vector<float> depths_;    // of each panorama's directions
    std::vector<float> costs_;     // of each direction as a gaze; 0 lacks nothing
};

}  // namespace mandelmarch
