// SPDX-License-Identifier: Apache-2.0
// What pools ask of a pack width. Define MM_REAL.

// Guard: once for each instruction set.
#if defined(MM_WIDTH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MM_WIDTH_INL_H
#undef MM_WIDTH_INL_H
#else
#define MM_WIDTH_INL_H
#endif

#include "backends/openmp/ray_pool.h"
#include "backends/openmp/variant.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {

// A sample of each ray of a pack that is on, and the pixels of rays that have hit.
struct Width {
    int registers;  // of a pack
    void (*probe)(const void* scene, const RayPool<MM_REAL>& pool, int from,
                  const hwy::HWY_NAMESPACE::Mask<hwy::HWY_NAMESPACE::ScalableTag<MM_REAL>>* on, MM_REAL* distances,
                  RayPool<MM_REAL>::Whole* iterations);
    void (*shade)(const void* scene, const RayPool<MM_REAL>& pool, int count, const Canvas<MM_REAL>& canvas,
                  Spent& spent);
    // The same for hits that have a look's surroundings from their neighbours.
    void (*shade_sharing)(const void* scene, const RayPool<MM_REAL>& pool, int count, const Canvas<MM_REAL>& canvas,
                          Spent& spent);
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
