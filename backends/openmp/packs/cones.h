// SPDX-License-Identifier: Apache-2.0
// Marches one cone around all rays of a subtile, to find how far these rays can advance together.

// Stores the t at which each active cone ends, at the index of its subtile.
HWY_NOINLINE void end_cones(Drawing& d, const RayPack& a, const mask& on)
{
    Int places[places_room] = {};
    MM_REAL starts[places_room] = {};
    store_compact(a.pixel, on, places);
    store_compact(cone_end(d.scene, a.ray), on, starts);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) d.canvas.block_start[places[i]] = starts[i];
#if MM_COUNTED
    d.spent.de_calls += sum_of(a.ray.de_calls, on);
    d.spent.iterations += sum_of(a.ray.iterations, on);
#endif
}

// Begins a cone for every subtile. If Canvas::cones is false, only stores the t at which the cone's axis enters the
// enlarged hull (Scene::subtile_hull): if any ray of a subtile meets the scene's hull, the axis of the subtile's cone
// meets the enlarged hull.
HWY_NOINLINE void begin_cones(Drawing& d, const Blocks& blocks)
{
    for (int from = 0; from < blocks.count; from += pack_lanes) {
        RayPack a;
        a.pixel = load_lanes(blocks.number + from);
        a.ray = begin_cone(d.scene, real_of(load_lanes(blocks.left + from)), real_of(load_lanes(blocks.bottom + from)),
                           subtile_side);
        mask ended = first_lanes(blocks.count - from);
        if (d.canvas.cones) {
            const mask go = ended && a.ray.t <= a.ray.end;
            append<roomless>(d.pools.cones, a, go);
            ended = ended && !go;
        }
        if (any(ended)) end_cones(d, a, ended);
    }
}

// Marches the cones of the pool until all have ended.
HWY_NOINLINE void march_cone_pool(Drawing& d)
{
    while (d.pools.cones.size > 0) {
        step_pool<RayPack, roomless>(d, d.pools.cones, StepKind::march_cones,
                                     [&](RayPack& a, const mask& ended) MM_INLINED { end_cones(d, a, ended); });
    }
}
