// SPDX-License-Identifier: Apache-2.0
// Interface between counting.cpp and the counting kernels.
#pragma once

#include "bench/counting.h"

namespace mandelmarch::bench {

// Sums over pixels that go into a Count.
struct PixelCount {
    std::array<Operations, stage_count> stages;
    Work work;
    std::uint64_t hits = 0;
};

// Draws pixel (i, j) and appends the iterations of each of its ray's steps. `scene` points to the kernel's Scene.
using CountPixel = void (*)(const void* scene, int i, int j, PixelCount& to, RaySteps& steps);

struct CountingKernel {
    CountPixel in_double, in_float;
};

// Returns nullptr for a fractal without a kernel. Generated.
const CountingKernel* counting_kernel(std::string_view fractal);

}  // namespace mandelmarch::bench
