// SPDX-License-Identifier: Apache-2.0
// The body of every stages_*.cpp: included once per instruction set by Highway's foreach_target.h. No include guard.

#include "core/kernel/prelude/vectorless.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::bench {
namespace HWY_NAMESPACE {
namespace {

#if MM_VECTORLESS
// Without vectors openmp has no packs.
StageKernel<MM_REAL> kernel() { return {}; }
#else

using openmp::block_side;
using openmp::Canvas;
using openmp::Lattice;
using openmp::most_lanes;
using openmp::pool_rays;
using openmp::RayPool;
using openmp::Spent;
using openmp::Tiles;

// As the timed pictures are drawn.
#define MM_COUNTED !MM_FAST
#include "backends/openmp/widths.h"
#undef MM_COUNTED

using namespace pools;

constexpr int most_packs = pool_rays / pack_lanes + 2;

struct Memory {
    Pools pools;
    vec3 normals[most_packs];
    Pixel pixels[most_packs];
};

HWY_INLINE double* place(double* seconds, TimedStage stage) { return seconds + static_cast<int>(stage); }

HWY_NOINLINE vec3 normal_of(const Scene& scene, const Hit& hit)
{
    const real t = landing(scene, hit);
    const real back = (scene.canonical != 0 ? t : hit.t) * real(scene.tolerance);
    const vec3 p = along(along(pools::wide(scene.eye), hit.direction, t), hit.direction, -back);
    return normal_at(scene, p, is_hit(hit)).direction;
}

// What shade() does beside the normal.
HWY_NOINLINE Pixel shaded(const Scene& scene, const Hit& hit, const vec3& normal)
{
    Pixel pixel = missed(scene, hit);
    const mask on = is_hit(hit);
    pixel.colour = pick3(on, lit(scene, hit.direction, normal), pixel.colour);
    pixel.depth = pick(on, landing(scene, hit), pixel.depth);
    return pixel;
}

// shade_pool() in three passes, each timed.
HWY_NOINLINE void shade_apart(Drawing& d, Memory& memory, bool all, double (*now)(), double* seconds)
{
    const Scene& scene = d.scene;
    Pool& ended = d.pools.ended;
    const int packs = all ? (ended.size + pack_lanes - 1) / pack_lanes : ended.size / pack_lanes;
    const double first = now();
    for (int k = 0; k < packs; ++k) {
        Hit hit = load<Arrival>(ended, k * pack_lanes).hit;
        hit.state = pick(first_lanes(ended.size - k * pack_lanes), hit.state, no_hit());
        memory.normals[k] = normal_of(scene, hit);
    }
    const double second = now();
    for (int k = 0; k < packs; ++k) {
        memory.pixels[k] = shaded(scene, load<Arrival>(ended, k * pack_lanes).hit, memory.normals[k]);
    }
    const double third = now();
    for (int k = 0; k < packs; ++k) {
        const whole places = load<Arrival>(ended, k * pack_lanes).pixel;
        store_pixels(memory.pixels[k], places, first_lanes(ended.size - k * pack_lanes), d.canvas, d.spent);
    }
    keep_rest(ended, packs * pack_lanes);
    *place(seconds, TimedStage::normal) += second - first;
    *place(seconds, TimedStage::shade) += third - second;
    *place(seconds, TimedStage::output) += now() - third;
}

// draw_tiles() with a clock. Finished rays are shaded before march_pool() or refine_pool() have to, but for rare ones.
void profile_tiles(const void* data, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* at, double (*now)(),
                   double* seconds)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    Memory& memory = *static_cast<Memory*>(at);
    Drawing d = drawing(scene, canvas, tiles, memory.pools, wide::width);
    auto& [pool, cones, hits, ended, refining] = memory.pools;
    bool more = true;
    double last = now();
    const auto took = [&](TimedStage stage) {
        const double here = now();
        *place(seconds, stage) += here - last;
        last = here;
    };
    while (more || pool.size > 0) {
        more = more && begin_tiles(d);
        took(TimedStage::begin);
        march_pool(d);
        took(TimedStage::march);
        while (hits.size > pool_rays / 2) refine_pool(d);
        took(TimedStage::refine);
        if (ended.size > pool_rays / 4) shade_apart(d, memory, false, now, seconds);
        last = now();
    }
    while (hits.size > 0) {
        refine_pool(d);
        took(TimedStage::refine);
        if (ended.size > pool_rays / 4) shade_apart(d, memory, false, now, seconds);
        last = now();
    }
    shade_apart(d, memory, true, now, seconds);
}

StageKernel<MM_REAL> kernel()
{
    return {hwy::TargetName(HWY_TARGET), wide::pack_lanes, sizeof(Memory), profile_tiles, draw_wide};
}
#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mandelmarch::bench {

HWY_EXPORT(kernel);

StageKernel<MM_REAL> MM_STAGES();
StageKernel<MM_REAL> MM_STAGES() { return HWY_DYNAMIC_DISPATCH(kernel)(); }

}  // namespace mandelmarch::bench
#endif
