// SPDX-License-Identifier: Apache-2.0
// Chooses the camera's gaze over time.
#pragma once

#include <span>
#include <vector>

#include "flight/field/shapes.h"
#include "flight/path/path.h"
#include "flight/plan/trajectory.h"

namespace mandelmarch {

// Panoramas (depths in all directions) at points along a curve. Each direction has a cost: it is high if a camera that
// looks there sees little.
class Director {
public:
    Director(const Shapes& shapes, const Curve& track);

    // Returns the gaze for the first `frames` frames (at least two) of a trajectory along the curve, as unit vectors.
    // The trajectory should have look_ahead more frames. The gaze at every tenth frame is chosen by dynamic programming
    // (Bellman) so that the sum of three costs is minimal: the cost of the direction, of its angle to the motion, and
    // of the turn. In between, the gaze is interpolated. The result is not smooth; see smoothed_gaze().
    std::vector<Vector> gaze(const Trajectory& ride, int frames) const;

    // Returns the median motion of the picture's pixels from one frame to the next, in picture heights. It is computed
    // by median_motion() from the panorama closest to the frames. `sample`: their (fractional) index in the curve.
    double motion(double sample, const Frame& from, const Frame& to) const;

private:
    // Writes the cost of each direction of a panorama to `costs`.
    static void rate(std::span<const float> depths, double clearance, std::span<float> costs);
    std::size_t panorama_at(double sample) const;

    std::vector<double> samples_;  // for each panorama: its index in the curve
    std::vector<float> depths_;    // for each direction of each panorama
    std::vector<float> costs_;     // for each direction of each panorama; 0: a good view
};

}  // namespace mandelmarch
