// Cones before rays: how far the rays of a block can go together, first those of 8 x 8 pixels, then of 2 x 2. Included
// by pool.h, in its namespace; no guard.

constexpr int log2_of(int n) { return n == 1 ? 0 : 1 + log2_of(n / 2); }

// What stands at each lane's place.
template <class D>
HWY_INLINE hn::Vec<D> looked_up(D d, const hn::TFromD<D>* from, hn::Vec<Wholes> places)
{
    return hn::TableLookupLanes(hn::LoadU(d, from), hn::IndicesFromVec(d, places));
}

constexpr int fine_side = 2;
constexpr int fine_across = block_side / fine_side;
constexpr int fine_cones = fine_across * fine_across;  // of a block

#if MM_COUNTED
// What cones cost, each in its place.
template <int most>
struct ConeCosts {
    Int estimates[most] = {};
    Int iterations[most] = {};

    HWY_INLINE void store(const Int* places, const effort& spent_estimates, const effort& spent_iterations,
                          const mask& on)
    {
        Int costs[2][pack_lanes + register_lanes] = {};
        store_compact(spent_estimates, on, costs[0]);
        store_compact(spent_iterations, on, costs[1]);
        const int lanes = lanes_on(on);
        for (int i = 0; i < lanes; ++i) {
            estimates[places[i]] = costs[0][i];
            iterations[places[i]] = costs[1][i];
        }
    }

    // Those of cones from `first` on to the rays that begin at them, in their order, where the bits of `inside` are 0:
    // one for each cone.
    HWY_INLINE void give(Ray& ray, int first, hn::Vec<Wholes> cones, hn::Vec<Wholes> inside) const
    {
        const auto counts = hn::Eq(inside, hn::Zero(Wholes()));
        ray.estimates.of[0] = hn::IfThenElseZero(counts, looked_up(Wholes(), estimates + first, cones));
        ray.iterations.of[0] = hn::IfThenElseZero(counts, looked_up(Wholes(), iterations + first, cones));
    }

    HWY_INLINE void move(int to, int from)
    {
        estimates[to] = estimates[from];
        iterations[to] = iterations[from];
    }

    // That of a cone of which no ray begins.
    HWY_INLINE void add_to(Spent& spent, int cone) const
    {
        spent.estimates += static_cast<std::uint64_t>(estimates[cone]);
        spent.iterations += static_cast<std::uint64_t>(iterations[cone]);
    }
};
#else
template <int most>
struct ConeCosts {
    HWY_INLINE void store(const Int*, const effort&, const effort&, const mask&) {}
    HWY_INLINE void give(Ray&, int, hn::Vec<Wholes>, hn::Vec<Wholes>) const {}
    HWY_INLINE void move(int, int) {}
    HWY_INLINE void add_to(Spent&, int) const {}
};
#endif

// Where cones came to. What a cone cost is counted for one of its rays.
template <int side>
struct Cones {
    static constexpr int most =
        most_blocks * block_pixels / (side * side) + register_lanes;  // whole registers can be read
    MM_REAL start[most] = {};
    ConeCosts<most> costs;
};
using BlockCones = Cones<block_side>;
using FineCones = Cones<fine_side>;

// Where a cone starts that has left the hull: no ray goes there.
HWY_INLINE MM_REAL beyond(const Drawing& d) { return 2 * d.scene.end; }

// Where the cones that are on have come to, to their places.
template <int side>
HWY_NOINLINE void store_cones(whole places, real t, effort estimates, effort iterations, mask on, Cones<side>& cones)
{
    constexpr int room = pack_lanes + register_lanes;
    Int at[room] = {};
    MM_REAL start[room];
    store_compact(places, on, at);
    store_compact(t, on, start);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) cones.start[at[i]] = start[i];
    cones.costs.store(at, estimates, iterations, on);
}

// Cones that have ended.
template <int side>
HWY_INLINE void end_cones(const Drawing& d, const Traveller& a, const mask& on, Cones<side>& cones)
{
    real t = a.ray.t;
    if (side == block_side) t = pick(t <= a.ray.end, t, beyond(d));
    store_cones(a.pixel, t, a.ray.estimates, a.ray.iterations, on, cones);
}

// Begins the cones that are on, (i, j) the pixels of their axes. Each has its place among the others, where it starts
// and what was spent on it already. An axis is in the hull around blocks wherever one of the cone's rays is in the
// hull.
template <int side>
HWY_INLINE void begin_cones(Drawing& d, Traveller& a, const real& i, const real& j, const mask& on, Cones<side>& cones)
{
    const Ray from = a.ray;
    a.ray = begin(side == block_side ? d.around_blocks : d.scene, i, j);
    // A ray at a fine cone's edge may meet the hull before the axis does. An axis that misses it goes nowhere.
    a.ray.t = side == block_side ? larger(from.t, a.ray.t) : from.t;
    a.ray.estimates = from.estimates;
    a.ray.iterations = from.iterations;
    const mask go = on && a.ray.t <= a.ray.end;
    append(d.pools.cones, a, go);
    if (any(on && !go)) end_cones(d, a, on && !go, cones);
}

// Begins a cone for every block.
HWY_NOINLINE void begin_block_cones(Drawing& d, const Blocks& blocks, BlockCones& cones)
{
    const real middle = MM_REAL(0.5) * (block_side - 1);
    for (int from = 0; from < blocks.count; from += pack_lanes) {
        Traveller a;
        a.pixel = lane_numbers() + whole(static_cast<Int>(from));
        a.ray.t = 0;
        a.ray.estimates = 0;
        a.ray.iterations = 0;
        begin_cones(d, a, real_of(load_lanes(blocks.left + from)) + middle,
                    real_of(load_lanes(blocks.bottom + from)) + middle, first_lanes(blocks.count - from), cones);
    }
}

// Begins the fine cones of every block, where its own came to.
HWY_NOINLINE void begin_fine_cones(Drawing& d, const Blocks& blocks, const BlockCones& from, FineCones& cones)
{
    static_assert(fine_cones % register_lanes == 0 && fine_side == 2);
    const real middle = MM_REAL(0.5) * (fine_side - 1);
    for (int n = 0; n < blocks.count * fine_cones; n += pack_lanes) {
        const int block = n / fine_cones;
        const auto place = hn::Iota(Wholes(), static_cast<Int>(n % fine_cones));
        whole x;
        whole y;
        x.of[0] = hn::ShiftLeft<1>(hn::And(place, hn::Set(Wholes(), fine_across - 1)));
        y.of[0] = hn::ShiftLeft<1>(hn::ShiftRight<log2_of(fine_across)>(place));
        Traveller a;
        a.pixel = lane_numbers() + whole(static_cast<Int>(n));
        a.ray.t = from.start[block];
        from.costs.give(a.ray, block, hn::Zero(Wholes()), place);
        begin_cones(d, a, real_of(x + whole(blocks.left[block])) + middle,
                    real_of(y + whole(blocks.bottom[block])) + middle, first_lanes(register_lanes), cones);
    }
}

// Marches the cones that have begun, of side x side pixels each.
template <int side>
HWY_NOINLINE void march_cones(Drawing& d, Cones<side>& cones)
{
    const scalar span = d.canvas.pitch * (MM_REAL(0.5) * (side - 1));
    while (d.pools.cones.size > 0) {
        sample_pool(
            d, d.pools.cones, steps_at_once,
            [&](Ray& ray, const Estimate& here, const mask& on) MM_INLINED {
                ray = advanced_cone(d.scene, ray, span, here, on);
                return on && cone_goes(ray);
            },
            [&](Traveller& a, const mask& stopped) MM_INLINED { end_cones(d, a, stopped, cones); });
    }
}
