// SPDX-License-Identifier: Apache-2.0
// What is done to all rays of a pool: marching, refining, shading.

// Guard: once for each pack with pools.
#if defined(MM_PASSES_INL_H) == defined(MM_POOL_TOGGLE)
#ifdef MM_PASSES_INL_H
#undef MM_PASSES_INL_H
#else
#define MM_PASSES_INL_H
#endif

#include "backends/openmp/drawing-inl.h"
#include "backends/openmp/pixels-inl.h"
#include "backends/openmp/rays-inl.h"
#include "backends/openmp/sharing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

// The lanes of a pack that are on, a mask for each of its registers.
struct PackLanes {
    hn::Mask<Reals> of[most_lanes / register_lanes];

    HWY_INLINE PackLanes(const Drawing& d, int lanes)
    {
        for (int u = 0; u < d.wide.registers; ++u) of[u] = first_lanes(lanes - u * register_lanes).of[0];
    }
};

HWY_INLINE mask mask_of(hn::Mask<Reals> lanes)
{
    mask on;
    on.of[0] = lanes;
    return on;
}

// One sample for each ray of a pack that is on. take(a, estimate, on) changes some fields of the rays of a register and
// returns which stay on. Returns how many do.
template <class Kind, Fields held, Fields changed, class Take>
HWY_INLINE int take_samples(const Drawing& d, Pool& pool, int from, PackLanes& on, Take take)
{
    alignas(64) MM_REAL distances[most_lanes];
    alignas(64) Int iterations[most_lanes];
    d.wide.probe(&d.scene, pool, from, on.of, distances, iterations);
    int lanes = 0;
    for (int u = 0; u < d.wide.registers; ++u) {
        const int at = from + u * register_lanes;
        Kind a = load<Kind, held>(pool, at);
        Estimate here;
        here.distance = load_lanes(distances + u * register_lanes);
        here.iterations = load_lanes(iterations + u * register_lanes);
        const mask stay = take(a, here, mask_of(on.of[u]));
        store<changed>(a, pool, at);
        on.of[u] = stay.of[0];
        lanes += lanes_on(stay);
    }
    return lanes;
}

// Samples for every ray of a pool, at most `at_once` a ray, pack by pack until a quarter of a pack's lanes has ended.
// Rays that go on are stored without gaps; ended(rays, lanes) gets the others.
template <class Kind, Fields held, Fields changed, class Take, class Ended>
HWY_INLINE void sample_pool(Drawing& d, Pool& pool, int at_once, Take take, Ended ended)
{
    const int size = pool.size;
    pool.size = 0;
    for (int from = 0; from < size; from += d.lanes()) {
        PackLanes on(d, size - from);
        const int enough = (size - from < d.lanes() ? size - from : d.lanes()) * 3 / 4;
        int step = 0;
        int going = 0;
        do {
            going = take_samples<Kind, held, changed>(d, pool, from, on, take);
        } while (++step < at_once && going > enough);
        for (int u = 0; u < d.wide.registers; ++u) {
            const int at = from + u * register_lanes;
            Kind a = load<Kind, held>(pool, at);
            const mask go = mask_of(on.of[u]);
            append<held>(pool, a, go);
            const mask stopped = first_lanes(size - at) && !go;
            if (any(stopped)) ended(a, stopped);
        }
    }
}

// Forgets the first `done` rays of a pool that has less than a pack more.
template <Fields held>
HWY_INLINE void keep_rest(Pool& pool, int done)
{
    const int size = pool.size;
    pool.size = 0;
    for (int from = done; from < size; from += pack_lanes) {
        Arrival a = load<Arrival, held>(pool, from);
        append<held>(pool, a, first_lanes(size - from));
    }
}

// Shades a pool's rays but an incomplete last pack; that one too if `all`.
template <Fields held>
HWY_INLINE void shade_packs_of(Drawing& d, Pool& pool, bool all)
{
    const int pack = d.shading.registers * register_lanes;
    const int count = all ? pool.size : pool.size / pack * pack;
    (held.reals == arrived.reals ? d.shading.shade : d.shading.shade_sharing)(&d.scene, pool, count, d.canvas, d.spent);
    keep_rest<held>(pool, count);
}

// Moves the rays that have ended and share surroundings to their own pool.
HWY_NOINLINE void split_sharing(Drawing& d)
{
    Pool& ended = d.pools.ended;
    const int size = ended.size;
    ended.size = d.pools.alone;
    for (int from = ended.size; from < size; from += pack_lanes) {
        Arrival a = load<Arrival, arrived>(ended, from);
        const mask on = first_lanes(size - from);
        const mask shared = find_shared(d, a, on);
        append<arrived_sharing>(d.pools.sharing, a, shared);
        append<arrived>(ended, a, on && !shared);
        if (d.pools.sharing.size > pool_rays - pack_lanes) shade_packs_of<arrived_sharing>(d, d.pools.sharing, false);
    }
    d.pools.alone = ended.size;
}

// Shades rays that have ended, all if `all`, else enough that the pool has room for another pack.
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

HWY_INLINE void append_ended(Drawing& d, Arrival& a, const mask& on)
{
    append<arrived>(d.pools.ended, a, on);
    if (d.pools.ended.size > pool_rays - pack_lanes) shade_pool(d, false);
}

// The next root of the hits that are on and need one; returns which those are.
HWY_INLINE mask aim(const Scene& scene, Hit& hit, const mask& on)
{
    const mask coarse = on && refining(scene, hit);
    hit = aimed(hit, coarse);
    return coarse && hit.state > settled();
}

// Begins to refine the hits that have not begun; those that need no refinement are shaded next.
HWY_NOINLINE void begin_refining(Drawing& d)
{
    Pool& hits = d.pools.hits;
    const int size = hits.size;
    hits.size = d.pools.refining;
    for (int from = hits.size; from < size; from += pack_lanes) {
        Arrival a = load<Arrival, arrived>(hits, from);
        const mask on = first_lanes(size - from);
        const mask coarse = aim(d.scene, a.hit, on);
        append<arrived>(hits, a, coarse);
        append_ended(d, a, on && !coarse);
    }
}

// One step of refinement for every hit; those that need no more are shaded next.
HWY_NOINLINE void refine_pool(Drawing& d)
{
    const Scene& scene = d.scene;
    begin_refining(d);
    sample_pool<Arrival, arrived, refined>(
        d, d.pools.hits, 1,
        [&](Arrival& a, const Estimate& here, const mask& on) MM_INLINED {
            a.hit = narrowed(scene, a.hit, here, on);
            return aim(scene, a.hit, on);
        },
        [&](Arrival& a, const mask& done) MM_INLINED { append_ended(d, a, done); });
    d.pools.refining = d.pools.hits.size;
}

// Leaves the depths of rays of a lattice for the pixels between.
HWY_INLINE void leave_depths(const Drawing& d, const Traveller& a, const real& t, const mask& on)
{
    Int places[places_room] = {};
    MM_REAL ts[places_room] = {};
    store_compact(a.pixel, on, places);
    store_compact(t, on, ts);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) d.canvas.neighbour_depth[places[i] / 2] = ts[i];
}

// What becomes of rays that neither go on nor are off.
HWY_INLINE void stop_marching(Drawing& d, Traveller& a, const mask& on)
{
    const Scene& scene = d.scene;
    Arrival b{stopped(scene, a.ray), a.pixel, {}};
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

// Some steps of marching for every ray; hits go on to be refined, or to be shaded where none is.
template <bool keeps_room>
HWY_NOINLINE void march_rays(Drawing& d)
{
    const Scene& scene = d.scene;
    const bool between = d.canvas.lattice.before > 0;
    const real width = MM_REAL(0.5) * static_cast<MM_REAL>(d.canvas.lattice.apart) * d.canvas.spacing;
    sample_pool<Traveller, keeps_room ? every_field : roomless, keeps_room ? marched_with_room : marched>(
        d, d.pools.marching, steps_at_once,
        [&](Traveller& a, const Estimate& here, const mask& on) MM_INLINED {
            if (keeps_room) a.room = pick(on, smaller(a.room, here.distance - width * a.ray.t), a.room);
            a.ray = advanced(scene, a.ray, here, on);
            mask stay = on && marching(scene, a.ray);
            if (between && any(on && !stay)) {
                const mask late = on && begun_too_late(scene, a.ray);
                a.ray = begun_alone(scene, a.ray, late);
                stay = stay || late;
            }
            return stay;
        },
        [&](Traveller& a, const mask& on) MM_INLINED { stop_marching(d, a, on); });
}

HWY_INLINE void march_pool(Drawing& d)
{
    if (d.canvas.lattice.apart > 1) {
        march_rays<true>(d);
    } else {
        march_rays<false>(d);
    }
}

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
