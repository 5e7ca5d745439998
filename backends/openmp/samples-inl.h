// SPDX-License-Identifier: Apache-2.0
// What pools ask of a pack width: samples, and finished pixels.

// Guard: once for each pack.
#if defined(MM_SAMPLES_INL_H) == defined(MM_PACK_TOGGLE)
#ifdef MM_SAMPLES_INL_H
#undef MM_SAMPLES_INL_H
#else
#define MM_SAMPLES_INL_H
#endif

#include "backends/openmp/pixels-inl.h"
#include "backends/openmp/rays-inl.h"
#include "backends/openmp/width-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

// The next sample of each ray or hit of a pack that is on; `on` has a mask for each register.
HWY_NOINLINE void probe_pack(const void* data, const Pool& pool, int from, const hn::Mask<Reals>* on,
                             MM_REAL* distances, Int* iterations)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    // Of either kind: both have these fields at the same places.
    const Hit next = load<Arrival, probed>(pool, from).hit;
    mask lanes;
    EACH_REGISTER(lanes.of[u] = on[u];)
    const Estimate here = probe_root(scene, next, lanes);
    store_lanes(here.distance, distances);
    store_lanes(here.iterations, iterations);
}

// Shades `count` hits of a pool.
HWY_NOINLINE void shade_rays(const void* data, const Pool& pool, int count, const Canvas<MM_REAL>& canvas, Spent& spent)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    for (int from = 0; from < count; from += pack_lanes) {
        Arrival a = load<Arrival, arrived>(pool, from);
        const mask on = first_lanes(count - from);
        // Lanes beyond the last ray hit nothing.
        a.hit.state = pick(on, a.hit.state, no_hit());
        store_pixels(shade(scene, a.hit), a.pixel, on, canvas, spent);
    }
}

constexpr Width width{MM_REGISTERS, probe_pack, shade_rays};

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
