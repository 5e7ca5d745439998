// SPDX-License-Identifier: Apache-2.0
// Distances of points and lengths of rays, computed with the kernel source. This header contains plain data only,
// because translation units that are compiled for one instruction set include it, too.
#pragma once

#include <cstddef>
#include <string_view>

namespace mandelmarch::field {

// Points (or vectors) as one array for each coordinate.
struct Points {
    const double* x;
    const double* y;
    const double* z;
};

// Limits of a ray of length t. It ends where the estimate is at most floor + tolerance * t, where t reaches `end`, or
// after `steps` steps.
struct Reach {
    double floor;
    double tolerance;
    double end;
    int steps;
};

struct Kernel {
    int lanes;  // `count` below must be a multiple of this
    // Writes the estimate at each point. `scene` points to the kernel's Scene in double precision.
    void (*distances)(const void* scene, Points points, std::size_t count, double* out);
    // Writes the length of each ray, at most `reach.end`. `along`: unit vectors.
    void (*casts)(const void* scene, Points from, Points along, Reach reach, std::size_t count, double* out);
};

// Returns the functions for the fractal called `name`. Throws Unavailable if this build does not contain it.
Kernel kernel_of(std::string_view name);

}  // namespace mandelmarch::field
