// SPDX-License-Identifier: Apache-2.0
// Chooses the camera's gaze over time: of all possible sequences of directions, the one that shows most.
#pragma once

#include <span>
#include <vector>

#include "flight/field/shapes.h"
#include "flight/path/path.h"
#include "flight/plan/trajectory.h"

namespace mandelmarch {

// Panoramas at points along a curve, with a cost for each direction as a gaze.
class Director {
public:
    Director(const Shapes& shapes, const Curve& track);

    // Returns the gaze for the first `frames` frames (at least two) of a trajectory along the curve, as unit vectors.
    // The trajectory should continue for look_ahead frames. Dynamic programming (Bellman) over directions at every
    // tenth frame minimises the sum of three costs: features missing from the view, angle to the direction of motion,
    // and turns. smoothed_gaze() smooths the result.
    std::vector<Vector> gaze(const Trajectory& ride, int frames) const;

    // Returns the picture's median motion from one frame to the next, as median_motion(), computed from the panorama
    // nearest to a sample of the curve.
    double motion(double sample, const Frame& from, const Frame& to) const;

private:
    static void rate(std::span<const float> depths, double clearance, std::span<float> costs);
    std::size_t panorama_at(double sample) const;

    std::vector<double> samples_;  // index in the curve, for each panorama
    std::vector<float> depths_;    // for each direction of each panorama
    std::vector<float> costs_;     // of each direction as a gaze; 0: nothing is missing
};

}  // namespace mandelmarch
