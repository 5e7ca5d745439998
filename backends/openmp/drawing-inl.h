// SPDX-License-Identifier: Apache-2.0
// What a thread draws, and the pools of its rays.

// Guard: once for each pack (end_pack.h).
#ifndef MM_DRAWING_INL_H
#define MM_DRAWING_INL_H

#include "backends/openmp/rays-inl.h"
#include "backends/openmp/variant.h"
#include "backends/openmp/width-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

static_assert(MM_REGISTERS == 1);

// A thread's memory.
struct Pools {
    Pool marching;
    Pool cones;
    Pool hits;     // to be refined
    Pool ended;    // to be shaded
    Pool sharing;  // to be shaded with surroundings of their neighbours
    int refining;  // the first hits that are being refined; the others have not begun
    int alone;     // the first of `ended` that share nothing; of the others it is not known
};

// What a thread draws, and with what.
struct Drawing {
    const Scene& scene;
    Scene around_blocks;  // the same with the canvas's block_hull
    const Canvas<MM_REAL>& canvas;
    const Tiles& tiles;
    Pools& pools;
    Sampling sampling;
    Shading shading;
    Spent spent;
};

// Empty pools.
HWY_INLINE Drawing drawing(const Scene& scene, const Canvas<MM_REAL>& canvas, const Tiles& tiles, Pools& pools,
                           const Sampling& sampling, const Shading& shading)
{
    pools.refining = pools.marching.size = pools.cones.size = pools.hits.size = pools.ended.size = 0;
    pools.alone = pools.sharing.size = 0;
    Scene around_blocks = scene;
    around_blocks.hull = canvas.block_hull;
    return {scene, around_blocks, canvas, tiles, pools, sampling, shading, {0, 0, 0}};
}

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
