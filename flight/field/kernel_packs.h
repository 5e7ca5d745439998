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
#endif

HWY_INLINE vec3 load3(Points from, std::size_t at)
{
    return vec3(load(from.x + at), load(from.y + at), load(from.z + at));
}

void distances(const layout_f64::Scene& data, Points points, std::size_t count, double* out)
{
    const Scene& scene = reinterpret_cast<const Scene&>(data);
    const mask on = real(0.0) < real(1.0);
    for (std::size_t i = 0; i < count; i += pack_lanes) store(estimate(scene, load3(points, i), on).distance, out + i);
}

void casts(const layout_f64::Scene& data, Points from, Points along_, Reach reach, std::size_t count, double* out)
{
    const Scene& scene = reinterpret_cast<const Scene&>(data);
    for (std::size_t i = 0; i < count; i += pack_lanes) {
        const vec3 origin = load3(from, i);
        const vec3 direction = load3(along_, i);
        real t = 0;
        mask on = t < real(reach.end);
        for (int step = 0; step < reach.steps && any(on); ++step) {
            const Estimate here = estimate(scene, along(origin, direction, t), on);
            on = on && here.distance > real(reach.tolerance) * t + real(reach.floor);
            t = pick(on, t + here.distance, t);
            on = on && t < real(reach.end);
        }
        store(smaller(t, real(reach.end)), out + i);
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
