// SPDX-License-Identifier: Apache-2.0
// The kernel text in packs of one register, with the pools, and in packs of four. Included for each instruction set, in
// a namespace of its own, with MM_COUNTED, 1 or 0: whether work is counted; no guard.
namespace hn = hwy::HWY_NAMESPACE;

// What pools ask of a pack width: a sample of each ray of a pack that is on, and the pixels of rays that have hit.
struct Width {
    int registers;  // of a pack
    void (*probe)(const void* scene, const RayPool<MM_REAL>& pool, int from,
                  const hn::Mask<hn::ScalableTag<MM_REAL>>* on, MM_REAL* distances,
                  RayPool<MM_REAL>::Whole* iterations);
    void (*shade)(const void* scene, const RayPool<MM_REAL>& pool, int count, const Canvas<MM_REAL>& canvas,
                  Spent& spent);
};

#define MM_REGISTERS 1
namespace pools {
#include "backends/openmp/pool.h"
#include "core/kernel/prelude/undefine.h"
#undef EACH_REGISTER
}  // namespace pools
#undef MM_REGISTERS

#ifndef MANDELMARCH_ONE_WIDTH
// Four registers hide the arithmetic's latency, at the price of some spilled values. In fast mode an iteration of the
// Mandelbulb takes long enough for three, which spill less (docs/notes/experiments.md).
#if MM_FAST && defined(MM_FRACTAL_mandelbulb) && HWY_TARGET <= HWY_AVX3
#define MM_REGISTERS 3
#else
#define MM_REGISTERS 4
#endif
namespace wide {
#include "backends/openmp/samples.h"
#include "core/kernel/prelude/undefine.h"
#undef EACH_REGISTER
}  // namespace wide
#undef MM_REGISTERS
#else
namespace wide = pools;
#endif

// Draws tiles with samples of one register, and of the wide pack.
HWY_MAYBE_UNUSED Spent draw_narrow(const void* scene, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* memory)
{
    return pools::draw_tiles(scene, canvas, tiles, memory, pools::width);
}

HWY_MAYBE_UNUSED Spent draw_wide(const void* scene, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* memory)
{
    return pools::draw_tiles(scene, canvas, tiles, memory, wide::width);
}
