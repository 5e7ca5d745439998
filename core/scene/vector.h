// SPDX-License-Identifier: Apache-2.0
// Vectors of doubles on the host, for cameras, descriptors and the reference renderer.
#pragma once

#include <cmath>

namespace mandelmarch {

struct Vector {
    double x = 0, y = 0, z = 0;
    bool operator==(const Vector&) const = default;
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Vector a) { return std::sqrt(dot(a, a)); }
inline Vector cross(Vector a, Vector b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vector unit(Vector a)
{
    const double l = length(a);
    return {a.x / l, a.y / l, a.z / l};
}

}  // namespace mandelmarch
