// SPDX-License-Identifier: Apache-2.0
// Passes over all rays of a pool: marching, refinement, shading.

HWY_INLINE mask mask_of(hn::Mask<Reals> lanes)
{
    mask on;
    on.of[0] = lanes;
    return on;
}

// Marches every ray of a pool by some steps, pack by pack. Moves the rays that continue to the front of the pool,
// without gaps, and passes the others to ended(rays, lanes).
template <class Kind, Fields held, class Ended>
HWY_INLINE void step_pool(Drawing& d, Pool& pool, StepKind kind, Ended ended)
{
    const int size = pool.size;
    pool.size = 0;
    for (int from = 0; from < size; from += d.sampling.registers * register_lanes) {
        hn::Mask<Reals> going[most_lanes / register_lanes];
        d.sampling.take_steps(scene_as<KernelScene<MM_REAL>>(d.scene), d.canvas, pool, kind, from, size - from, going);
        for (int u = 0; u < d.sampling.registers; ++u) {
            const int at = from + u * register_lanes;
            Kind a = load<Kind, held>(pool, at);
            const mask go = mask_of(going[u]);
            append<held>(pool, a, go);
            const mask stopped = first_lanes(size - at) && !go;
            if (any(stopped)) ended(a, stopped);
        }
    }
}

// Removes the first `done` rays of a pool, and moves the others to its front.
template <Fields held>
HWY_INLINE void keep_rest(Pool& pool, int done)
{
    const int size = pool.size;
    pool.size = 0;
    for (int from = done; from < size; from += pack_lanes) {
        HitPack a = load<HitPack, held>(pool, from);
        append<held>(pool, a, first_lanes(size - from));
    }
}

// Shades the rays of a pool. An incomplete last pack remains in the pool unless `all` is true.
template <Fields held>
HWY_INLINE void shade_packs_of(Drawing& d, Pool& pool, bool all)
{
    const int count = all ? pool.size : pool.size / d.shading.lanes * d.shading.lanes;
    const ShadeHits shade = held.reals == arrived.reals ? d.shading.shade : d.shading.shade_sharing;
    shade(scene_as<KernelScene<MM_REAL>>(d.scene), pool, count, d.canvas, d.spent);
    keep_rest<held>(pool, count);
}

// Moves ended rays to the pool `sharing` if they can use the occlusion of neighbouring pixels.
HWY_NOINLINE void split_sharing(Drawing& d)
{
    Pool& ended = d.pools.ended;
    const int size = ended.size;
    ended.size = d.pools.alone;
    for (int from = ended.size; from < size; from += pack_lanes) {
        HitPack a = load<HitPack, arrived>(ended, from);
        const mask on = first_lanes(size - from);
        const mask shared = find_shared(d, a, on);
        append<arrived_sharing>(d.pools.sharing, a, shared);
        append<arrived>(ended, a, on && !shared);
        if (d.pools.sharing.size > pool_rays - pack_lanes) shade_packs_of<arrived_sharing>(d, d.pools.sharing, false);
    }
    d.pools.alone = ended.size;
}

// Shades ended rays. If `all` is true, shades all of them; otherwise shades enough to make room for another pack.
HWY_NOINLINE void shade_pool(Drawing& d, bool all)
{
    if (shares(d)) {
        split_sharing(d);
        if (all) shade_packs_of<arrived_sharing>(d, d.pools.sharing, true);
        if (!all && d.pools.ended.size <= pool_rays / 2) return;
    }
    shade_packs_of<arrived>(d, d.pools.ended, all);
    d.pools.alone = d.pools.ended.size;
}

HWY_INLINE void append_ended(Drawing& d, HitPack& a, const mask& on)
{
    append<arrived>(d.pools.ended, a, on);
    if (d.pools.ended.size > pool_rays - pack_lanes) shade_pool(d, false);
}

// Begins the refinement of new hits. Hits that need no refinement are passed on to be shaded.
HWY_NOINLINE void begin_refining(Drawing& d)
{
    Pool& hits = d.pools.hits;
    const int size = hits.size;
    hits.size = d.pools.refining;
    for (int from = hits.size; from < size; from += pack_lanes) {
        HitPack a = load<HitPack, arrived>(hits, from);
        const mask on = first_lanes(size - from);
        const mask coarse = aim(d.scene, a.hit, on);
        append<arrived>(hits, a, coarse);
        append_ended(d, a, on && !coarse);
    }
}

// Refines every hit once. Hits that need no further refinement are passed on to be shaded.
HWY_NOINLINE void refine_pool(Drawing& d)
{
    begin_refining(d);
    step_pool<HitPack, arrived>(d, d.pools.hits, StepKind::refine,
                                [&](HitPack& a, const mask& done) MM_INLINED { append_ended(d, a, done); });
    d.pools.refining = d.pools.hits.size;
}

// Stores the depths of a lattice's rays. The rays of the pixels in between will begin near these depths.
HWY_INLINE void leave_depths(const Drawing& d, const RayPack& a, const real& t, const mask& on)
{
    Int places[places_room] = {};
    MM_REAL ts[places_room] = {};
    store_compact(a.pixel, on, places);
    store_compact(t, on, ts);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) d.canvas.neighbour_depth[places[i] / 2] = ts[i];
}

// Processes rays that have stopped: hits are passed on to be refined or shaded, misses are stored as finished pixels.
HWY_INLINE void stop_marching(Drawing& d, RayPack& a, const mask& on)
{
    const Scene& scene = d.scene;
    HitPack b{stopped(scene, a.ray), a.pixel, {}};
    const mask hit = on && is_hit(b.hit);
    const mask gone = on && !hit;
    if (d.canvas.lattice.apart > 1) {
        const mask roomy = gone && a.room > 0 && a.ray.t > a.ray.end;
        leave_depths(d, a, pick(hit, a.ray.last_t, clear_miss()), hit || roomy);
    }
    if (any(gone)) store_pixels(missed(scene, b.hit), b.pixel, gone, d.canvas, d.spent);
    if (scene.canonical == 0) return append_ended(d, b, hit);
    append<arrived>(d.pools.hits, b, hit);
    while (d.pools.hits.size > pool_rays - pack_lanes) refine_pool(d);
}

// Marches every ray of the pool by some steps.
HWY_NOINLINE void march_pool(Drawing& d)
{
    const auto ended = [&](RayPack& a, const mask& on) MM_INLINED { stop_marching(d, a, on); };
    if (d.canvas.lattice.apart > 1) {
        step_pool<RayPack, every_field>(d, d.pools.marching, StepKind::march, ended);
    } else {
        step_pool<RayPack, roomless>(d, d.pools.marching, StepKind::march, ended);
    }
}
