// SPDX-License-Identifier: Apache-2.0
// Interface by which the pools call functions on packs of other widths. The including file defines MM_REAL.
// The include guard allows one inclusion per instruction set.
#if defined(MM_WIDTH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MM_WIDTH_INL_H
#undef MM_WIDTH_INL_H
#else
#define MM_WIDTH_INL_H
#endif

#include "backends/openmp/variant.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {

enum class StepKind { march, march_cones, refine };

// Advances the pack at index `from` of a pool. `rays`: number of the pool's rays from that index on. Marches the pack
// until a quarter of its rays have ended or for a limited number of steps, or refines it once. `going` receives, per
// register, the mask of the rays that continue.
using TakeSteps = void (*)(const void* scene, const Canvas<MM_REAL>& canvas, RayPool<MM_REAL>& pool, StepKind kind,
                           int from, int rays,
                           hwy::HWY_NAMESPACE::Mask<hwy::HWY_NAMESPACE::ScalableTag<MM_REAL>>* going);

struct Sampling {
    int registers;  // registers per pack
    TakeSteps take_steps;
};

// Shades the first `count` hits of a pool.
using ShadeHits = void (*)(const void* scene, const RayPool<MM_REAL>& pool, int count, const Canvas<MM_REAL>& canvas,
                           WorkCounts& spent);

struct Shading {
    int lanes;  // lanes per pack
    ShadeHits shade;
    ShadeHits shade_sharing;  // for hits that have the occlusion of their neighbours
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
