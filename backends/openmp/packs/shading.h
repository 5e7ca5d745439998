// SPDX-License-Identifier: Apache-2.0
// Shading of packs of hits, for pools.

// Stores the occlusion of hits on the canvas. The pixels in between, which are rendered later, can share it.
HWY_INLINE void leave_surroundings(const Canvas<MM_REAL>& canvas, const whole& pixels, const Occlusion& found,
                                   const mask& on)
{
    Int places[places_room] = {};
    MM_REAL along_normal[places_room] = {};
    MM_REAL sunwards[places_room] = {};
    store_compact(pixels, on, places);
    store_compact(found.along_normal, on, along_normal);
    store_compact(found.sunwards, on, sunwards);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) {
        canvas.along_normal[places[i] / 2] = along_normal[i];
        canvas.sunwards[places[i] / 2] = sunwards[i];
    }
}

// Shades the first `count` hits of a pool in a picture with shared occlusion. If the template argument `shared` is
// true, the hits already have the occlusion of their neighbours; otherwise their occlusion is computed.
template <bool shared>
HWY_NOINLINE void shade_among_rays(const KernelScene<MM_REAL>& data, const Pool& pool, int count,
                                   const Canvas<MM_REAL>& canvas, WorkCounts& spent)
{
    const Scene& scene = scene_as<Scene>(data);
    for (int from = 0; from < count; from += pack_lanes) {
        HitPack a = load < HitPack, shared ? arrived_sharing : arrived > (pool, from);
        const mask on = first_lanes(count - from);
        a.hit.state = pick(on, a.hit.state, no_hit());
        const ShadingPoint at = shading_point(scene, a.hit);
        const Normal normal = normal_at(scene, at.p, at.t, on);
        Occlusion found;
        if constexpr (shared) {
            found.along_normal = a.shared.along_normal;
            found.sunwards = a.shared.sunwards;
            found.de_calls = 0;
            found.iterations = 0;
        } else {
            const vec3 n = facing(scene, a.hit.direction, normal.direction, at.t);
            found = occlusion(scene, at.p, n, at.t, on);
            if (canvas.lattice.apart > 1) leave_surroundings(canvas, a.pixel, found, on);
        }
        const Pixel pixel = shade_among(scene, a.hit, missed(scene, a.hit), at, normal, found);
        store_pixels(pixel, a.pixel, on, canvas, spent);
    }
}

// Shades the first `count` hits of a pool.
HWY_NOINLINE void shade_rays(const KernelScene<MM_REAL>& data, const Pool& pool, int count,
                             const Canvas<MM_REAL>& canvas, WorkCounts& spent)
{
    if (canvas.sunwards != nullptr) return shade_among_rays<false>(data, pool, count, canvas, spent);
    const Scene& scene = scene_as<Scene>(data);
    for (int from = 0; from < count; from += pack_lanes) {
        HitPack a = load<HitPack, arrived>(pool, from);
        const mask on = first_lanes(count - from);
        // Marks the lanes after the last ray as misses.
        a.hit.state = pick(on, a.hit.state, no_hit());
        store_pixels(shade(scene, a.hit), a.pixel, on, canvas, spent);
    }
}

constexpr Shading shading{pack_lanes, shade_rays, shade_among_rays<true>};
