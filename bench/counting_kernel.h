// SPDX-License-Identifier: Apache-2.0
// Between counting.cpp and the kernel text that counts. Internal.
#pragma once

#include "bench/counting.h"

namespace mandelmarch::bench {

// What pixels add to a Count, before anything is divided.
struct PixelCount {
    std::array<Operations, stage_count> stages;
    Work work;
    std::uint64_t hits = 0;
};

// Draws pixel (i, j), and appends its ray's steps. `scene` is the text's Scene.
using CountPixel = void (*)(const void* scene, int i, int j, PixelCount& to, RaySteps& steps);

struct CountingKernel {
    CountPixel in_double, in_float;
};

// nullptr for a fractal without a text. Generated.
const CountingKernel* counting_kernel(std::string_view fractal);

}  // namespace mandelmarch::bench
