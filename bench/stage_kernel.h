// SPDX-License-Identifier: Apache-2.0
// openmp's scheduler with a clock between its stages. Plain data: it is shared with translation units that are compiled
// for one instruction set. Internal to the profile.
#pragma once

#include <cstddef>

#include "backends/openmp/variant.h"

namespace mandelmarch::bench {

enum class TimedStage { begin, march, refine, normal, shade, output };
inline constexpr int timed_stages = 6;

// Draws tiles as openmp does and adds the seconds of each stage to `seconds`. `memory` is `bytes` bytes, aligned to 64.
template <class Real>
struct StageKernel {
    const char* instruction_set;
    int pack;           // pixels at once
    std::size_t bytes;  // of memory
    void (*profile)(const void* scene, const openmp::Canvas<Real>& canvas, const openmp::Tiles& tiles, void* memory,
                    double (*now)(), double* seconds);
    openmp::DrawTiles<Real> draw;  // the same without a clock
};

}  // namespace mandelmarch::bench
