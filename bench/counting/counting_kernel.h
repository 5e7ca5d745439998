// SPDX-License-Identifier: Apache-2.0
// Interface between counting.cpp and the counting kernels.
#pragma once

#include "bench/counting/counting.h"

namespace mandelmarch::bench {

// Sums over pixels, from which a Count is computed.
struct PixelCount {
    std::array<Operations, stage_count> stages;
    Work work;
    std::uint64_t hits = 0;
};

// Renders pixel (i, j), adds its counts to `to`, and appends the number of DE iterations of each step of its ray to
// `steps`. `scene` points to the kernel's Scene.
using CountPixel = void (*)(const void* scene, int i, int j, PixelCount& to, RaySteps& steps);

struct CountingKernel {
    CountPixel in_double, in_float;
};

// Returns the counting kernel of a fractal, or nullptr if the fractal has no kernel. Its definition is generated from
// counting_kernels.cpp.in.
const CountingKernel* counting_kernel(std::string_view fractal);

}  // namespace mandelmarch::bench
