// SPDX-License-Identifier: Apache-2.0
// What is seen from a place, all around, in few directions.
#pragma once

#include <span>
#include <vector>

#include "flight/field/shapes.h"

namespace mandelmarch {

// Directions spread evenly over the sphere (a Fibonacci lattice: Gonzalez, "Measurement of areas on a sphere using
// Fibonacci and latitude-longitude lattices", Mathematical Geosciences 42, 2010), and which of them lie near which.
class Sphere {
public:
    // `count` directions. `window`: radians around a direction within which others are near it.
    Sphere(int count, double window);

    const std::vector<Vector>& directions() const { return directions_; }
    // The directions near a direction, itself first, then by their number.
    std::span<const int> near(int direction) const { return near_[static_cast<std::size_t>(direction)]; }
    int nearest(Vector unit_vector) const;

private:
    std::vector<Vector> directions_;
    std::vector<std::vector<int>> near_;
};

// The depths along all of the sphere's directions, place after place, in the scene's units; +infinity where nothing is
// met within `end`. `values`: of the shape that each place is in.
std::vector<float> panoramas(const Shapes& shapes, const Sphere& sphere, std::span<const Vector> places,
                             std::span<const double> values, double end);

}  // namespace mandelmarch
