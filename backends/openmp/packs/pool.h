// SPDX-License-Identifier: Apache-2.0
// The ray scheduler around the kernel. It keeps the SIMD lanes busy.
//
// A pool of rays, stored as a structure of arrays, is marched by some steps at a time. Rays that continue are stored
// without gaps. Hits wait in a second pool until whole packs of them can be refined and shaded. When the first pool
// runs low, the rays of another tile are added. Therefore a lane waits only in two cases. Within a DE evaluation it
// waits for slower lanes. When its ray has ended, it waits until a quarter of its pack's rays have ended, but for at
// most 15 steps (samples.h).
//
// The scheduler itself processes one SIMD register at a time, so that its values stay in registers. DE evaluations and
// shading use wider packs, in which the operations on one register hide the latency of those on another.

// Renders tiles until none are left.
HWY_MAYBE_UNUSED WorkCounts draw_tiles(const KernelScene<MM_REAL>& scene, const Canvas<MM_REAL>& canvas,
                                       const Tiles& tiles, void* memory, const Sampling& sampling,
                                       const Shading& shading)
{
    Drawing d = drawing(scene_as<Scene>(scene), canvas, tiles, *static_cast<Pools*>(memory), sampling, shading);
    bool more = true;
    while (more || d.pools.marching.size > 0) {
        more = more && begin_tiles(d);
        march_pool(d);
        while (d.pools.hits.size > pool_rays / 2) refine_pool(d);
    }
    while (d.pools.hits.size > 0) refine_pool(d);
    shade_pool(d, true);
    return d.spent;
}

// Calls draw_tiles(). Sampling and Shading are template parameters, so that the address of this function has the type
// DrawTiles and can be stored in a Variant.
template <const Sampling& sampling, const Shading& shading>
WorkCounts draw(const KernelScene<MM_REAL>& scene, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* memory)
{
    return draw_tiles(scene, canvas, tiles, memory, sampling, shading);
}
