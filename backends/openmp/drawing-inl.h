// SPDX-License-Identifier: Apache-2.0
// What a thread draws, and the pools of its rays.

// Guard: once for each pack with pools.
#if defined(MM_DRAWING_INL_H) == defined(MM_POOL_TOGGLE)
#ifdef MM_DRAWING_INL_H
#undef MM_DRAWING_INL_H
#else
#define MM_DRAWING_INL_H
#endif

#include "backends/openmp/rays-inl.h"
#include "backends/openmp/samples-inl.h"
#include "backends/openmp/variant.h"
#include "backends/openmp/width-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

static_assert(MM_REGISTERS == 1);

// Steps before rays are stored without gaps again, at most.
constexpr int steps_at_once = 16;

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
    Width wide;     // for samples
    Width shading;  // for finished rays
    Spent spent;

    int lanes() const { return wide.registers * register_lanes; }  // of a pack of samples
};

// Empty pools. A look at a hit, and differences, take samples of their own, which want wide packs.
HWY_INLINE Drawing drawing(const Scene& scene, const Canvas<MM_REAL>& canvas, const Tiles& tiles, Pools& pools,
                           const Width& wide)
{
    pools.refining = pools.marching.size = pools.cones.size = pools.hits.size = pools.ended.size = 0;
    pools.alone = pools.sharing.size = 0;
    const bool sampling = scene.colouring > 1 || scene.differences != 0;
    Scene around_blocks = scene;
    around_blocks.hull = canvas.block_hull;
    return {scene, around_blocks, canvas, tiles, pools, wide, sampling ? wide : width, {0, 0, 0}};
}

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
