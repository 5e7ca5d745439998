// SPDX-License-Identifier: Apache-2.0
// Types of the functions that the pools' code calls to process packs of other widths.

enum class StepKind { march, march_cones, refine };

// Advances the pack at index `from` of a pool. `rays`: number of the pool's rays from that index on. With
// StepKind::refine, refines the pack once. Otherwise marches it until a quarter of its rays have ended, or for a
// limited number of steps. `going` receives, per register, the mask of the rays that continue.
using TakeSteps = void (*)(const KernelScene<MM_REAL>& scene, const Canvas<MM_REAL>& canvas, RayPool<MM_REAL>& pool,
                           StepKind kind, int from, int rays,
                           hwy::HWY_NAMESPACE::Mask<hwy::HWY_NAMESPACE::ScalableTag<MM_REAL>>* going);

struct Sampling {
    int registers;  // registers per pack
    TakeSteps take_steps;
};

// Shades the first `count` hits of a pool.
using ShadeHits = void (*)(const KernelScene<MM_REAL>& scene, const RayPool<MM_REAL>& pool, int count,
                           const Canvas<MM_REAL>& canvas, WorkCounts& spent);

struct Shading {
    int lanes;  // lanes per pack
    ShadeHits shade;
    ShadeHits shade_sharing;  // for hits that have the occlusion of their neighbours
};
