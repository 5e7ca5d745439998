// SPDX-License-Identifier: Apache-2.0
// The kernel text's distances over arrays of points and rays. Plain data: it is shared with translation units that are
// compiled for one instruction set.
#pragma once

#include <cstddef>
#include <string_view>

namespace mandelmarch::field {

// Arrays of three coordinates each.
struct Points {
    const double* x;
    const double* y;
    const double* z;
};

// How far a ray is followed: it ends where the estimate falls under floor + tolerance t, or at t = end.
struct Reach {
    double floor;
    double tolerance;
    double end;
    int steps;
};

struct Kernel {
    int lanes;  // `count` below is a multiple of it
    // `scene` is the text's Scene in double.
    void (*distances)(const void* scene, Points points, std::size_t count, double* out);
    // t where each ray ends, `end` if nothing is in its way. Directions are unit vectors.
    void (*casts)(const void* scene, Points from, Points along, Reach reach, std::size_t count, double* out);
};

// Throws Unavailable for a fractal that was not built.
Kernel kernel_of(std::string_view name);

}  // namespace mandelmarch::field
