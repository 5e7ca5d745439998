// SPDX-License-Identifier: Apache-2.0
// Panoramas: the depths from a point in a fixed set of directions.
#pragma once

#include <span>
#include <vector>

#include "flight/field/shapes.h"

namespace mandelmarch {

// Directions spread evenly over the sphere, and for each of them the directions near it. The directions are a Fibonacci
// lattice (Gonzalez, "Measurement of areas on a sphere using Fibonacci and latitude-longitude lattices", Mathematical
// Geosciences 42, 2010).
class Sphere {
public:
    // `window`: two directions are near each other if the angle between them, in radians, is smaller.
    Sphere(int count, double window);

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

}  // namespace mandelmarch
