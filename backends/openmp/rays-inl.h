// SPDX-License-Identifier: Apache-2.0
// Packs of rays and of hits, loaded from and stored to pools.

// Include guard for one pack; end_pack.h removes it.
#ifndef MM_RAYS_INL_H
#define MM_RAYS_INL_H

#include <cstddef>

#include "backends/openmp/pack-inl.h"
#include "backends/openmp/variant.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

using Pool = RayPool<MM_REAL>;
static_assert(pack_lanes <= most_lanes);

// Rays with the indices of their pixels in the canvas.
struct RayPack {
    Ray ray;
    whole pixel;
    real room;  // min, over the ray's samples, of the estimate minus half the distance between the lattice's rays there
};

// Occlusion that a hit takes from its neighbours.
struct Shared {
    real along_normal;
    real sunwards;
};

// Stopped rays with the indices of their pixels in the canvas.
struct HitPack {
    Hit hit;
    whole pixel;
    Shared shared;
};

// Bit masks of the fields of a RayPack or a HitPack. Bit n stands for the pool's array number n. Fields of type `real`:
constexpr unsigned direction_bits = 7 << 0;  // x, y, z
constexpr unsigned end_bit = 1 << 3;         // end of a ray, or state of a hit
constexpr unsigned t_bit = 1 << 4;           // t of the next sample of a ray or a hit
constexpr unsigned sample_bits = 0xf << 5;   // of a ray: t and estimate of the last two samples; of a hit: its bracket
constexpr unsigned room_bit = 1 << 9;
constexpr unsigned shared_bits = 3 << 9;  // of a HitPack; uses the array of `room` and the next one
// Fields of integer type:
constexpr unsigned steps_bit = 1 << 0;
constexpr unsigned pixel_bit = 1 << 1;
constexpr unsigned work_bits = 3 << 2;  // numbers of DE evaluations and of iterations
constexpr unsigned every_whole = steps_bit | pixel_bit | work_bits;

// A set of fields.
struct Fields {
    unsigned reals;
    unsigned wholes;
};
constexpr Fields every_field{direction_bits | end_bit | t_bit | sample_bits | room_bit, every_whole};
constexpr Fields roomless{direction_bits | end_bit | t_bit | sample_bits, every_whole};  // for rays that leave no depth
constexpr Fields arrived{roomless.reals, MM_COUNTED ? every_whole : pixel_bit};          // for a HitPack
constexpr Fields arrived_sharing{arrived.reals | shared_bits, arrived.wholes};
constexpr Fields probed{direction_bits | t_bit, 0};  // fields that a DE evaluation needs
constexpr Fields room_alone{room_bit, 0};
// Fields that a marching step changes (except `room`), and fields that a refinement changes.
constexpr Fields marched{t_bit | sample_bits, steps_bit | work_bits};
constexpr Fields refined{end_bit | t_bit | sample_bits, work_bits};

// Calls on_real(array number, pack) or on_whole(array number, pack) for each field of the set `some`. Direction and t
// of the next sample have the same array numbers in a RayPack and a HitPack.
template <Fields some, class OnReal, class OnWhole>
HWY_INLINE void each_field(RayPack& a, OnReal on_real, OnWhole on_whole)
{
    const auto real_field = [&](unsigned f, real& v) MM_INLINED {
        if ((some.reals >> f & 1) != 0) on_real(f, v);
    };
    const auto whole_field = [&](unsigned f, whole& v) MM_INLINED {
        if ((some.wholes >> f & 1) != 0) on_whole(f, v);
    };
    real_field(0, a.ray.direction.x);
    real_field(1, a.ray.direction.y);
    real_field(2, a.ray.direction.z);
    real_field(3, a.ray.end);
    real_field(4, a.ray.t);
    real_field(5, a.ray.last_t);
    real_field(6, a.ray.last_distance);
    real_field(7, a.ray.before_t);
    real_field(8, a.ray.before_distance);
    real_field(9, a.room);
    whole_field(0, a.ray.steps);
    whole_field(1, a.pixel);
#if MM_COUNTED
    whole_field(2, a.ray.de_calls);
    whole_field(3, a.ray.iterations);
#endif
}

template <Fields some, class OnReal, class OnWhole>
HWY_INLINE void each_field(HitPack& a, OnReal on_real, OnWhole on_whole)
{
    const auto real_field = [&](unsigned f, real& v) MM_INLINED {
        if ((some.reals >> f & 1) != 0) on_real(f, v);
    };
    const auto whole_field = [&](unsigned f, whole& v) MM_INLINED {
        if ((some.wholes >> f & 1) != 0) on_whole(f, v);
    };
    real_field(0, a.hit.direction.x);
    real_field(1, a.hit.direction.y);
    real_field(2, a.hit.direction.z);
    real_field(3, a.hit.state);
    real_field(4, a.hit.t);
    real_field(5, a.hit.below_t);
    real_field(6, a.hit.below_f);
    real_field(7, a.hit.above_t);
    real_field(8, a.hit.above_f);
    real_field(9, a.shared.along_normal);
    real_field(10, a.shared.sunwards);
    whole_field(0, a.hit.steps);
    whole_field(1, a.pixel);
#if MM_COUNTED
    whole_field(2, a.hit.de_calls);
    whole_field(3, a.hit.iterations);
#endif
}

HWY_INLINE real load_lanes(const MM_REAL* from)
{
    real a;
    EACH_REGISTER(a.of[u] = hn::LoadU(Reals(), from + u * register_lanes);)
    return a;
}

HWY_INLINE whole load_lanes(const Int* from)
{
    whole a;
    EACH_REGISTER(a.of[u] = hn::LoadU(Wholes(), from + u * register_lanes);)
    return a;
}

HWY_INLINE void store_lanes(const real& from, MM_REAL* to)
{
    EACH_REGISTER(hn::StoreU(from.of[u], Reals(), to + u * register_lanes);)
}

HWY_INLINE void store_lanes(const whole& from, Int* to)
{
    EACH_REGISTER(hn::StoreU(from.of[u], Wholes(), to + u * register_lanes);)
}

#if !MM_COUNTED
HWY_INLINE void store_lanes(const counter&, Int*) {}
#endif

template <class Kind, Fields held = every_field>
HWY_INLINE Kind load(const Pool& pool, int from)
{
    Kind a;
    each_field<held>(
        a, [&](unsigned f, real& v) MM_INLINED { v = load_lanes(pool.real_fields[f] + from); },
        [&](unsigned f, whole& v) MM_INLINED { v = load_lanes(pool.whole_fields[f] + from); });
    return a;
}

// Stores the fields `some` of a pack at index `at` of the pool.
template <Fields some, class Kind>
HWY_INLINE void store(Kind& a, Pool& pool, int at)
{
    each_field<some>(
        a, [&](unsigned f, real& v) MM_INLINED { store_lanes(v, pool.real_fields[f] + at); },
        [&](unsigned f, whole& v) MM_INLINED { store_lanes(v, pool.whole_fields[f] + at); });
}

HWY_INLINE int lanes_on(const mask& on)
{
    int lanes = 0;
    EACH_REGISTER(lanes += static_cast<int>(hn::CountTrue(Reals(), on.of[u]));)
    return lanes;
}

// Moves the active lanes to the front. For 64-bit lanes Highway uses a table even if the CPU has an instruction for it,
// so this instruction is used directly.
HWY_INLINE hn::Vec<Reals> compressed(hn::Vec<Reals> a, hn::Mask<Reals> on)
{
#if HWY_TARGET <= HWY_AVX3 && !MM_REAL_IS_FLOAT
    return hn::Vec<Reals>{_mm512_maskz_compress_pd(on.raw, a.raw)};
#else
    return hn::Compress(a, on);
#endif
}

HWY_INLINE hn::Vec<Wholes> compressed(hn::Vec<Wholes> a, hn::Mask<Reals> on)
{
#if HWY_TARGET <= HWY_AVX3 && !MM_REAL_IS_FLOAT
    return hn::Vec<Wholes>{_mm512_maskz_compress_epi64(on.raw, a.raw)};
#else
    return hn::Compress(a, hn::RebindMask(Wholes(), on));
#endif
}

// append() is inlined if compressed() is a single instruction; otherwise its code is too long.
#if HWY_TARGET <= HWY_AVX3
#define MM_APPEND HWY_INLINE
#else
#define MM_APPEND HWY_NOINLINE HWY_MAYBE_UNUSED
#endif

// Appends the rays of the active lanes to the pool, which must have room for a whole pack.
template <Fields held = every_field, class Kind>
MM_APPEND void append(Pool& pool, Kind& a, const mask& on)
{
    const int lanes = lanes_on(on);
    const int at = pool.size;
    pool.size = at + lanes;
    if (lanes == pack_lanes) {
        store<held>(a, pool, at);
    } else if (lanes > 0) {
        int to = at;
        EACH_REGISTER(const auto keep = on.of[u]; each_field<held>(
                          a,
                          [&](unsigned f, real& v)
                              MM_INLINED { hn::StoreU(compressed(v.of[u], keep), Reals(), pool.real_fields[f] + to); },
                          [&](unsigned f, whole& v) MM_INLINED {
                              hn::StoreU(compressed(v.of[u], keep), Wholes(), pool.whole_fields[f] + to);
                          });
                      to += static_cast<int>(hn::CountTrue(Reals(), keep));)
    }
}

// Returns the mask of the first `lanes` lanes.
HWY_INLINE mask first_lanes(int lanes)
{
    mask on;
    EACH_REGISTER(const int rest = lanes - u * register_lanes;
                  on.of[u] = hn::FirstN(Reals(), static_cast<std::size_t>(rest < 0 ? 0 : rest));)
    return on;
}

HWY_INLINE real real_of(const whole& a)
{
    real c;
    EACH_REGISTER(c.of[u] = hn::ConvertTo(Reals(), a.of[u]);)
    return c;
}

// Returns 0, 1, 2, ...: the number of each lane.
HWY_INLINE whole lane_numbers()
{
    whole a;
    EACH_REGISTER(a.of[u] = hn::Iota(Wholes(), static_cast<Int>(u * register_lanes));)
    return a;
}

// Finds the active hits that need refinement, sets the t of their next sample, and returns their mask.
HWY_INLINE mask aim(const Scene& scene, Hit& hit, const mask& on)
{
    const mask coarse = on && refining(scene, hit);
    hit = aimed(hit, coarse);
    return coarse && hit.state > settled();
}

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
