// SPDX-License-Identifier: Apache-2.0
// Panoramas (the depths from a point in a fixed set of directions), and the choice of the camera's gaze from them.
#pragma once

#include <span>
#include <vector>

#include "flight/field/field.h"
#include "flight/path/path.h"
#include "flight/ride/trajectory.h"

namespace mandelmarch {

// Directions spread evenly over the sphere, and for each of them the directions near it. The directions are a Fibonacci
// lattice (Gonzalez, "Measurement of areas on a sphere using Fibonacci and latitude-longitude lattices", Mathematical
// Geosciences 42, 2010).
class Sphere {
public:
    // `apart`: two directions are near each other if the angle between them, in radians, is smaller.
    Sphere(int count, double apart);

    const std::vector<Vector>& directions() const { return directions_; }
    // Returns the indices of the directions near a direction: first its own index, then the others in ascending order.
    std::span<const int> near(int direction) const { return near_[static_cast<std::size_t>(direction)]; }
    int nearest(Vector unit_vector) const;

private:
    std::vector<Vector> directions_;
    std::vector<std::vector<int>> near_;
};

// Returns the depths along all of the sphere's directions, place after place, in the scene's units. A depth is
// +infinity if the ray hits nothing within the length `end`. `values`: the shape parameter's value at each place.
std::vector<float> panoramas(const Shapes& shapes, const Sphere& sphere, std::span<const Vector> places,
                             std::span<const double> values, double end);

// A direction that the gaze should avoid in the 45 frames before and after a frame.
struct Avoided {
    std::size_t frame;
    Vector direction;  // unit vector
};

// Panoramas at points along a curve. Each direction has a cost, which is high if little is visible to a camera that
// looks in this direction.
class Director {
public:
    Director(const Shapes& shapes, const Curve& track);

    // Returns the gaze for the first `frames` frames (at least two) of a trajectory along the curve, as unit vectors.
    // The trajectory should have look_ahead frames more than `frames`. The gaze at every tenth frame is chosen by
    // dynamic programming (Bellman) so that the sum of four costs is minimal: the cost of the direction, of its angle
    // to the motion, of its closeness to an avoided direction, and of the turn. In between, the gaze is interpolated.
    // The result is not smooth; see smoothed_gaze(). Near a stop, the gaze follows the stop's direction alone.
    std::vector<Vector> gaze(const Trajectory& ride, int frames, std::span<const Stop> stops = {},
                             std::span<const Avoided> avoided = {}) const;

    // Returns the median motion of the picture's pixels from one frame to the next, in picture heights. It is computed
    // by median_motion() from the panorama closest to the camera. `sample`: the camera's position, as a fractional
    // index into the curve's samples.
    double motion(double sample, const Frame& from, const Frame& to) const;

private:
    // Writes the cost of each direction of a panorama to `costs`.
    static void rate(std::span<const float> depths, double clearance, std::span<float> costs);
    std::size_t panorama_at(double sample) const;
    // Returns the costs of all directions, for each of the given frames of a trajectory. A direction's cost depends on
    // its view, its angle to the motion, and its closeness to an avoided direction. Near a stop, it depends only on the
    // angle to the stop's direction.
    std::vector<double> slot_costs(const Trajectory& ride, std::span<const std::size_t> frames,
                                   std::span<const Stop> stops, std::span<const Avoided> avoided) const;

    int threads_;
    std::vector<double> samples_;  // for each panorama: its index in the curve
    std::vector<float> depths_;    // for each direction of each panorama
    std::vector<float> costs_;     // for each direction of each panorama; 0: a good view
};

}  // namespace mandelmarch
