// SPDX-License-Identifier: Apache-2.0
// The body of every kernel_FRACTAL.cpp. It does not have an include guard, because Highway's foreach_target.h includes
// it once per instruction set.
#undef MM_REAL
#undef MM_REAL_IS_FLOAT
#undef MM_FAST
#undef MM_REGISTERS
#undef MM_COUNTED
#define MM_REAL double
#define MM_REAL_IS_FLOAT 0
#define MM_FAST 0
#define MM_REGISTERS 4
#define MM_COUNTED 0

#include "core/kernel/prelude/vectorless.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::field {
namespace HWY_NAMESPACE {
namespace {

#if MM_VECTORLESS
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/text.h"

constexpr int pack_lanes = 1;

HWY_INLINE real load(const double* from) { return *from; }

HWY_INLINE void store(real from, double* to) { *to = from; }

HWY_INLINE mask first_lanes(int lanes) { return lanes > 0; }

HWY_INLINE int lanes_on(mask on) { return on ? 1 : 0; }

HWY_INLINE int store_active(real from, mask on, double* to)
{
    *to = from;
    return on ? 1 : 0;
}
#else
#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"

HWY_INLINE real load(const double* from)
{
    real to;
    for (int u = 0; u < MM_REGISTERS; ++u) to.of[u] = hn::LoadU(Reals(), from + u * register_lanes);
    return to;
}

HWY_INLINE void store(real from, double* to)
{
    for (int u = 0; u < MM_REGISTERS; ++u) hn::StoreU(from.of[u], Reals(), to + u * register_lanes);
}

HWY_INLINE mask first_lanes(int lanes)
{
    mask on;
    for (int u = 0; u < MM_REGISTERS; ++u) {
        on.of[u] = hn::FirstN(Reals(), static_cast<std::size_t>(HWY_MAX(lanes - u * register_lanes, 0)));
    }
    return on;
}

HWY_INLINE int lanes_on(const mask& on)
{
    int lanes = 0;
    for (int u = 0; u < MM_REGISTERS; ++u) lanes += static_cast<int>(hn::CountTrue(Reals(), on.of[u]));
    return lanes;
}

// Moves the active lanes to the front. AVX-512 has an instruction for this; Highway would use a table.
HWY_INLINE hn::Vec<Reals> compressed(hn::Vec<Reals> a, hn::Mask<Reals> on)
{
#if HWY_TARGET <= HWY_AVX3
    return hn::Vec<Reals>{_mm512_maskz_compress_pd(on.raw, a.raw)};
#else
    return hn::Compress(a, on);
#endif
}

// Stores the active lanes without gaps and returns their number. May overwrite pack_lanes numbers.
HWY_INLINE int store_active(const real& from, const mask& on, double* to)
{
    int count = 0;
    for (int u = 0; u < MM_REGISTERS; ++u) {
        hn::StoreU(compressed(from.of[u], on.of[u]), Reals(), to + count);
        count += static_cast<int>(hn::CountTrue(Reals(), on.of[u]));
    }
    return count;
}
#endif

void distances(const layout_f64::Scene& data, Triples points, std::size_t count, double* out)
{
    const Scene& scene = reinterpret_cast<const Scene&>(data);
    const mask on = real(0.0) < real(1.0);
    double of[3][pack_lanes];
    double found[pack_lanes];
    for (std::size_t first = 0; first < count; first += pack_lanes) {
        // The last point is repeated to fill the last pack.
        for (std::size_t i = 0; i < pack_lanes; ++i) {
            for (int c = 0; c < 3; ++c) of[c][i] = points[HWY_MIN(first + i, count - 1)][c];
        }
        store(estimate(scene, vec3(load(of[0]), load(of[1]), load(of[2])), on).distance, found);
        for (std::size_t i = first; i < HWY_MIN(first + pack_lanes, count); ++i) {
            out[i] = found[i - first] > 0 ? found[i - first] : 0;
        }
    }
}

constexpr int marching_rays = 256 > 2 * pack_lanes ? 256 : 2 * pack_lanes;
constexpr int steps_at_once = 16;

// Rays that march, without gaps. Rays that have ended are removed, and others are added, so that few lanes wait.
struct Marching {
    enum Field { x, y, z, along_x, along_y, along_z, length, steps, number, fields };

    double of[fields][marching_rays + pack_lanes] = {};
    int size = 0;
};

// Adds rays until there are marching_rays of them or none is left. `next`: number of the next ray to be added.
HWY_INLINE void add_rays(Marching& rays, Triples from, Triples along, std::size_t& next, std::size_t count)
{
    for (; rays.size < marching_rays && next < count; ++rays.size, ++next) {
        for (int c = 0; c < 3; ++c) {
            rays.of[Marching::x + c][rays.size] = from[next][c];
            rays.of[Marching::along_x + c][rays.size] = along[next][c];
        }
        rays.of[Marching::length][rays.size] = 0;
        rays.of[Marching::steps][rays.size] = 0;
        rays.of[Marching::number][rays.size] = static_cast<double>(next);
    }
}

// Takes up to steps_at_once steps with the pack of rays that begins at index `at`. Ends earlier when a quarter of them
// have ended, unless `alone` says that no other rays wait for lanes. Moves the rays that have not ended behind the
// rays.size rays that are kept already, and writes the lengths of the others to `out`.
HWY_INLINE void march(const Scene& scene, Marching& rays, int at, const mask& present, bool alone, Reach reach,
                      double* out)
{
    const auto field = [&](int f) { return load(rays.of[f] + at); };
    const vec3 origin{field(Marching::x), field(Marching::y), field(Marching::z)};
    const vec3 direction{field(Marching::along_x), field(Marching::along_y), field(Marching::along_z)};
    real t = field(Marching::length);
    real steps = field(Marching::steps);
    mask on = present && t < real(reach.end) && steps < real(reach.steps);
    const int enough = alone ? 0 : lanes_on(present) * 3 / 4;
    int step = 0;
    do {
        const Estimate here = estimate(scene, along(origin, direction, t), on);
        steps = steps + real(1.0);
        on = on && here.distance > real(reach.tolerance) * t + real(reach.floor);
        t = pick(on, t + here.distance, t);
        on = on && t < real(reach.end) && steps < real(reach.steps);
    } while (++step < steps_at_once && lanes_on(on) > enough);
    store(t, rays.of[Marching::length] + at);
    store(steps, rays.of[Marching::steps] + at);
    const mask ended = present && !on;
    if (any(ended)) {
        double lengths[pack_lanes];
        double numbers[pack_lanes];
        const int count = store_active(smaller(t, real(reach.end)), ended, lengths);
        store_active(field(Marching::number), ended, numbers);
        for (int i = 0; i < count; ++i) out[static_cast<std::size_t>(numbers[i])] = lengths[i];
    }
    if (at > rays.size || any(ended)) {
        for (auto& values : rays.of) store_active(load(values + at), on, values + rays.size);
    }
    rays.size += lanes_on(on);
}

void casts(const layout_f64::Scene& data, Triples from, Triples along, Reach reach, std::size_t count, double* out)
{
    const Scene& scene = reinterpret_cast<const Scene&>(data);
    Marching rays;
    for (std::size_t next = 0; next < count || rays.size > 0;) {
        add_rays(rays, from, along, next, count);
        const int size = rays.size;
        rays.size = 0;
        const bool alone = next == count && size <= pack_lanes;
        for (int at = 0; at < size; at += pack_lanes) march(scene, rays, at, first_lanes(size - at), alone, reach, out);
    }
}

#include "core/kernel/prelude/undefine.h"

Kernel kernel() { return {pack_lanes, distances, casts}; }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::field
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mandelmarch::field {

HWY_EXPORT(kernel);

Kernel MM_KERNEL() { return HWY_DYNAMIC_DISPATCH(kernel)(); }

}  // namespace mandelmarch::field
#endif
