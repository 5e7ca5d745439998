// SPDX-License-Identifier: Apache-2.0
// Between counting.cpp and the kernel text that counts. Internal.
#pragma once

#include <span>

#include "bench/counting.h"

namespace mandelmarch::bench {

struct PixelPlace {
    int i, j;
};

// What one pack adds to a Count, before anything is divided.
struct PackCount {
    std::array<Operations, stage_count> stages;
    Work work;
    std::uint64_t hits = 0;
    // Lanes times the most of any lane, and what the lanes really did, in the march.
    std::uint64_t step_slots = 0, steps = 0;
    std::uint64_t iteration_slots = 0, iterations = 0;
};

// Draws the pixels of one pack side by side, step by step. `scene` is the text's Scene.
using CountPack = void (*)(const void* scene, std::span<const PixelPlace> pixels, PackCount& to);

struct CountingKernel {
    CountPack in_double, in_float;
};

// nullptr for a fractal without a text. Generated.
const CountingKernel* counting_kernel(std::string_view fractal);

}  // namespace mandelmarch::bench
