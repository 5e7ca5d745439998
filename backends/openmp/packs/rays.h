// SPDX-License-Identifier: Apache-2.0
// Packs of rays and of hits, loaded from and stored to pools.

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
constexpr unsigned t_bit = 1 << 4;           // t of the next DE evaluation
constexpr unsigned sample_bits = 0xf << 5;   // of a ray: t and estimate of the last two samples; of a hit: its bracket
constexpr unsigned room_bit = 1 << 9;
constexpr unsigned shared_bits = 3 << 9;  // of a HitPack; uses the array of `room` and the next one
// Fields of integer type:
constexpr unsigned steps_bit = 1 << 0;
constexpr unsigned pixel_bit = 1 << 1;
constexpr unsigned work_bits = MM_COUNTED ? 3 << 2 : 0;  // numbers of DE evaluations and of iterations
constexpr unsigned every_whole = steps_bit | pixel_bit | work_bits;

// A set of fields.
struct Fields {
    unsigned reals;
    unsigned wholes;
};
constexpr Fields every_field{direction_bits | end_bit | t_bit | sample_bits | room_bit, every_whole};
constexpr Fields roomless{direction_bits | end_bit | t_bit | sample_bits, every_whole};  // for rays that store no depth
constexpr Fields arrived{roomless.reals, MM_COUNTED ? every_whole : pixel_bit};          // for a HitPack
constexpr Fields arrived_sharing{arrived.reals | shared_bits, arrived.wholes};
constexpr Fields probed{direction_bits | t_bit, 0};  // fields that a DE evaluation needs
constexpr Fields room_alone{room_bit, 0};
// Fields that a marching step changes (except `room`), and fields that a refinement changes.
constexpr Fields marched{t_bit | sample_bits, steps_bit | work_bits};
constexpr Fields refined{end_bit | t_bit | sample_bits, work_bits};

// Calls on_field(number, field) for each field whose bit is set in `some`. The first field has the number n, the next
// one n + 1, and so on.
template <unsigned some, unsigned n = 0, class OnField, class Field, class... Rest>
HWY_INLINE void each_of(OnField& on_field, Field& field, Rest&... rest)
{
    if constexpr ((some >> n & 1) != 0) on_field(n, field);
    if constexpr (sizeof...(rest) > 0) each_of<some, n + 1>(on_field, rest...);
}

// Calls on_real(array number, field) or on_whole(array number, field) for each field of the set `some`.
template <Fields some, class OnReal, class OnWhole>
HWY_INLINE void each_field(RayPack& a, OnReal on_real, OnWhole on_whole)
{
    Ray& ray = a.ray;
    each_of<some.reals>(on_real, ray.direction.x, ray.direction.y, ray.direction.z, ray.end, ray.t, ray.last_t,
                        ray.last_distance, ray.before_t, ray.before_distance, a.room);
    each_of<some.wholes>(on_whole, ray.steps, a.pixel, ray.de_calls, ray.iterations);
}

template <Fields some, class OnReal, class OnWhole>
HWY_INLINE void each_field(HitPack& a, OnReal on_real, OnWhole on_whole)
{
    Hit& hit = a.hit;
    each_of<some.reals>(on_real, hit.direction.x, hit.direction.y, hit.direction.z, hit.state, hit.t, hit.below_t,
                        hit.below_f, hit.above_t, hit.above_f, a.shared.along_normal, a.shared.sunwards);
    each_of<some.wholes>(on_whole, hit.steps, a.pixel, hit.de_calls, hit.iterations);
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

// Moves the active lanes to the front. AVX-512 has an instruction for this. Highway uses a table instead if lanes have
// 64 bits, so the instruction is called directly.
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
#undef MM_APPEND
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

// Finds the active hits that need refinement, sets the t of their next sample, and returns the mask of these hits.
HWY_INLINE mask aim(const Scene& scene, Hit& hit, const mask& on)
{
    const mask coarse = on && refining(scene, hit);
    hit = aimed(hit, coarse);
    return coarse && hit.state > settled();
}
