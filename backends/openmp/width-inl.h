// SPDX-License-Identifier: Apache-2.0
// What pools ask of packs of other widths. Define MM_REAL.

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

enum class StepKind { march, march_cones, refine };

// Steps of the pack at `from`, of which `rays` are left in the pool, a sample each: some until a quarter of the rays
// has ended, or one of refinement. `going` has a mask for each register, of the rays that go on.
using TakeSteps = void (*)(const void* scene, const Canvas<MM_REAL>& canvas, RayPool<MM_REAL>& pool, StepKind kind,
                           int from, int rays,
                           hwy::HWY_NAMESPACE::Mask<hwy::HWY_NAMESPACE::ScalableTag<MM_REAL>>* going);

struct Sampling {
    int registers;  // of a pack
    TakeSteps take_steps;
};

// The pixels of a pool's first hits.
using ShadeHits = void (*)(const void* scene, const RayPool<MM_REAL>& pool, int count, const Canvas<MM_REAL>& canvas,
                           Spent& spent);

struct Shading {
    int lanes;  // of a pack
    ShadeHits shade;
    ShadeHits shade_sharing;  // of hits that have a look's surroundings from their neighbours
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
