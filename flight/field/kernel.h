// SPDX-License-Identifier: Apache-2.0
// Distances from the kernel source, for arrays of points and rays. This header has plain data only, as it is shared
// with translation units that are compiled for one instruction set.
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

// Limits of a ray. It ends where the estimate falls below floor + tolerance t, at t = end, or after `steps` steps.
struct Reach {
    double floor;
    double tolerance;
    double end;
    int steps;
};

struct Kernel {
    int lanes;  // `count` below is a multiple of it
    // `scene`: the kernel's Scene in double precision.
    void (*distances)(const void* scene, Points points, std::size_t count, double* out);
    // Writes t at the end of each ray; `reach.end` if the ray hits nothing. `along`: unit vectors.
    void (*casts)(const void* scene, Points from, Points along, Reach reach, std::size_t count, double* out);
};

// `name`: a fractal's. Throws Unavailable if that fractal was not built.
Kernel kernel_of(std::string_view name);

}  // namespace mandelmarch::field
