// SPDX-License-Identifier: Apache-2.0
// Marching and refinement steps on packs of a pool. Each step makes one DE evaluation.

// Max steps of a pack before the rays that continue are compacted again.
constexpr int steps_at_once = 16;

// march_on(), march_cones_on() and refine_on() update the active rays, cones or hits of a pack with the estimate at
// their next sample, and return the mask of those that continue.
HWY_INLINE mask march_on(const Scene& scene, const Canvas<MM_REAL>& canvas, Pool& pool, int from, const Estimate& here,
                         const mask& on)
{
    RayPack a = load<RayPack, roomless>(pool, from);
    if (canvas.lattice.apart > 1) {
        const real width = MM_REAL(0.5) * static_cast<MM_REAL>(canvas.lattice.apart) * scene.spacing;
        a.room = load<RayPack, room_alone>(pool, from).room;
        a.room = pick(on, smaller(a.room, here.distance - width * a.ray.t), a.room);
        store<room_alone>(a, pool, from);
    }
    a.ray = advanced(scene, a.ray, here, on);
    mask stay = on && marching(scene, a.ray);
    if (canvas.lattice.before > 0 && any(on && !stay)) {
        const mask late = on && begun_too_late(scene, a.ray);
        a.ray = begun_alone(scene, a.ray, late);
        stay = stay || late;
    }
    store<marched>(a, pool, from);
    return stay;
}

HWY_INLINE mask march_cones_on(const Scene& scene, Pool& pool, int from, const Estimate& here, const mask& on)
{
    RayPack a = load<RayPack, roomless>(pool, from);
    a.ray = advanced_cone(scene, a.ray, cone_width(scene, subtile_side), here, on);
    store<marched>(a, pool, from);
    return on && cone_goes(a.ray);
}

HWY_INLINE mask refine_on(const Scene& scene, Pool& pool, int from, const Estimate& here, const mask& on)
{
    HitPack a = load<HitPack, arrived>(pool, from);
    a.hit = narrowed(scene, a.hit, here, on);
    const mask stay = aim(scene, a.hit, on);
    store<refined>(a, pool, from);
    return stay;
}

// A single function takes the steps of all kinds, so that the estimator is compiled once, inside the function's loop.
HWY_NOINLINE void take_steps(const KernelScene<MM_REAL>& data, const Canvas<MM_REAL>& canvas, Pool& pool, StepKind kind,
                             int from, int rays, hn::Mask<Reals>* going)
{
    const Scene& scene = scene_as<Scene>(data);
    mask on = first_lanes(rays);
    const int enough = (rays < pack_lanes ? rays : pack_lanes) * 3 / 4;
    int step = 0;
    do {
        // The fields of `probed` have the same array numbers for rays, cones and hits.
        const Estimate here = probe_root(scene, load<HitPack, probed>(pool, from).hit, on);
        if (kind == StepKind::march) {
            on = march_on(scene, canvas, pool, from, here, on);
        } else if (kind == StepKind::march_cones) {
            on = march_cones_on(scene, pool, from, here, on);
        } else {
            on = refine_on(scene, pool, from, here, on);
        }
    } while (kind != StepKind::refine && ++step < steps_at_once && lanes_on(on) > enough);
    EACH_REGISTER(going[u] = on.of[u];)
}

constexpr Sampling sampling{MM_REGISTERS, take_steps};
