// The stages of the kernel text in packs, one tile at a time. Plain data: it is shared with translation units that are
// compiled for one instruction set. Internal to the profile.
#pragma once

#include <cstddef>

#include "core/image/tile.h"

namespace mandelmarch::bench {

enum class TimedStage { begin, march, refine, normal, shade, output };
inline constexpr int timed_stages = 6;

// Runs one stage on the packs of the tile whose bottom left pixel is (left, bottom). `stored` keeps the packs between
// the stages: `bytes` bytes, aligned to 64. The last stage fills the tile.
template <class Real>
struct StageKernel {
    const char* instruction_set;
    int pack;           // pixels at once
    std::size_t bytes;  // that one tile's packs take
    void (*run)(TimedStage stage, const void* scene, int left, int bottom, void* stored, Tile<Real>& tile);
    void (*draw)(const void* scene, int left, int bottom, Tile<Real>& tile);  // all stages in one go
};

}  // namespace mandelmarch::bench
