// SPDX-License-Identifier: Apache-2.0
// Distances of points and lengths of rays, computed with the kernel source. This header contains plain data only. Code
// that is compiled for one instruction set includes it, too, and functions compiled there must not run on processors
// that lack these instructions.
#pragma once

#include <cstddef>
#include <string_view>

namespace mandelmarch::layout_f64 {
struct Scene;  // core/render/kernel_scene.h
}

namespace mandelmarch::field {

// Points (or vectors) as x, y and z, one point after another.
using Triples = const double (*)[3];

// Limits of a ray that has reached the length t. The ray ends if the estimate there is at most floor + tolerance * t,
// if t is at least `end`, or if the ray has taken `steps` steps.
struct Reach {
    double floor;
    double tolerance;
    double end;
    int steps;
};

struct Kernel {
    int lanes;
    // Writes the estimate at each point; 0 if it is negative or NaN.
    void (*distances)(const layout_f64::Scene& scene, Triples points, std::size_t count, double* out);
    // Writes the length of each ray, at most `reach.end`. `along`: unit vectors.
    void (*casts)(const layout_f64::Scene& scene, Triples from, Triples along, Reach reach, std::size_t count,
                  double* out);
};

// Returns the function that the build generates for a fractal from kernel.cpp.in (cmake/Kernels.cmake); nullptr if this
// build does not contain the fractal.
using MakeKernel = Kernel();
MakeKernel* kernel_maker(std::string_view fractal);

// Returns the functions for a fractal. Throws Unavailable if this build does not contain it.
Kernel kernel_of(std::string_view fractal);

}  // namespace mandelmarch::field
