// Cones before rays: how far the rays of a block of pixels can go together. Included by pool.h, in its namespace; no
// guard.

constexpr int log2_of(int n) { return n == 1 ? 0 : 1 + log2_of(n / 2); }

// What stands at each lane's place.
template <class D>
HWY_INLINE hn::Vec<D> looked_up(D d, const hn::TFromD<D>* from, hn::Vec<Wholes> places)
{
    return hn::TableLookupLanes(hn::LoadU(d, from), hn::IndicesFromVec(d, places));
}

// Some tiles, begun together so that their cones fill packs.
constexpr int group_tiles = 8;
struct Group {
    int count;
    int left[group_tiles];
    int bottom[group_tiles];
};

// The blocks of side x side pixels of a group, in the order of tiles, rows and columns.
constexpr int blocks_across(int side) { return tile_side / side; }
constexpr int blocks_of_tile(int side) { return blocks_across(side) * blocks_across(side); }

#if MM_COUNTED
// What cones cost, each in its place.
template <int most>
struct ConeCosts {
    Int estimates[most];
    Int iterations[most];

    HWY_INLINE void store(const Int* places, const Ray& ray, const mask& on)
    {
        Int costs[2][pack_lanes + register_lanes] = {};
        store_compact(ray.estimates, on, costs[0]);
        store_compact(ray.iterations, on, costs[1]);
        const int lanes = lanes_on(on);
        for (int i = 0; i < lanes; ++i) {
            estimates[places[i]] = costs[0][i];
            iterations[places[i]] = costs[1][i];
        }
    }

    // To what begins at `places` from `first` on, where the bits of `inside` are 0: one for each cone.
    HWY_INLINE void give(Ray& ray, int first, hn::Vec<Wholes> places, hn::Vec<Wholes> inside) const
    {
        const auto counts = hn::Eq(inside, hn::Zero(Wholes()));
        ray.estimates.of[0] = hn::IfThenElseZero(counts, looked_up(Wholes(), estimates + first, places));
        ray.iterations.of[0] = hn::IfThenElseZero(counts, looked_up(Wholes(), iterations + first, places));
    }
};
#else
template <int most>
struct ConeCosts {
    HWY_INLINE void store(const Int*, const Ray&, const mask&) {}
    HWY_INLINE void give(Ray&, int, hn::Vec<Wholes>, hn::Vec<Wholes>) const {}
};
#endif

// Where a group's cones came to. What a cone cost is counted for one of its rays.
template <int side>
struct Cones {
    static constexpr int most = group_tiles * blocks_of_tile(side) + register_lanes;  // whole registers can be read
    MM_REAL start[most];
    ConeCosts<most> costs;
};

// Where the cones that are on have come to, to their places.
template <int side>
HWY_NOINLINE void store_cones(const Traveller& a, const mask& on, Cones<side>& cones)
{
    constexpr int room = pack_lanes + register_lanes;
    Int at[room] = {};
    MM_REAL t[room];
    store_compact(a.pixel, on, at);
    store_compact(a.ray.t, on, t);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) cones.start[at[i]] = t[i];
    cones.costs.store(at, a.ray, on);
}

// Begins the cones that are on, (i, j) the pixels of their axes. Each has its place among the group's, where it starts
// and what was spent on it already.
template <int side>
HWY_INLINE void begin_cones(Drawing& d, Traveller& a, const real& i, const real& j, const mask& on, Cones<side>& cones)
{
    const Ray from = a.ray;
    a.ray = begin(d.scene, i, j);
    // A ray at the cone's edge may meet the hull before the axis does. An axis that misses it goes nowhere.
    a.ray.t = from.t;
    a.ray.estimates = from.estimates;
    a.ray.iterations = from.iterations;
    const mask go = on && a.ray.t <= a.ray.end;
    append(d.pools.cones, a, go);
    if (any(on && !go)) store_cones(a, on && !go, cones);
}

// The middle of the first of `side` pixels.
template <int side>
HWY_INLINE real middle_of(const whole& first)
{
    return real_of(first) + real(MM_REAL(0.5) * (side - 1));
}

// Begins one cone for every block of the group.
template <int side>
HWY_NOINLINE void begin_all_cones(Drawing& d, const Group& group, Cones<side>& cones)
{
    const int blocks = group.count * blocks_of_tile(side);
    for (int from = 0; from < blocks; from += pack_lanes) {
        Int left[pack_lanes];
        Int bottom[pack_lanes];
        for (int lane = 0; lane < pack_lanes; ++lane) {
            const int block = from + lane < blocks ? from + lane : blocks - 1;
            const int in_tile = block % blocks_of_tile(side);
            left[lane] = group.left[block / blocks_of_tile(side)] + in_tile % blocks_across(side) * side;
            bottom[lane] = group.bottom[block / blocks_of_tile(side)] + in_tile / blocks_across(side) * side;
        }
        Traveller a;
        a.pixel = lane_numbers() + whole(static_cast<Int>(from));
        a.ray.t = 0;
        a.ray.estimates = 0;
        a.ray.iterations = 0;
        begin_cones(d, a, middle_of<side>(load_lanes(left)), middle_of<side>(load_lanes(bottom)),
                    first_lanes(blocks - from), cones);
    }
}

// Begins one cone for every block of the group, where the larger block's cone came to.
template <int side, int parent_side>
HWY_NOINLINE void begin_all_cones(Drawing& d, const Group& group, const Cones<parent_side>& parents, Cones<side>& cones)
{
    static_assert(blocks_of_tile(side) % register_lanes == 0);
    constexpr int across = log2_of(blocks_across(side));
    constexpr int parents_across = log2_of(blocks_across(parent_side));
    constexpr int parent = log2_of(parent_side / side);
    for (int from = 0; from < group.count * blocks_of_tile(side); from += register_lanes) {
        const int tile = from / blocks_of_tile(side);
        const int first = tile * blocks_of_tile(parent_side);
        const auto block = hn::Iota(Wholes(), static_cast<Int>(from % blocks_of_tile(side)));
        const auto x = hn::And(block, hn::Set(Wholes(), blocks_across(side) - 1));
        const auto y = hn::ShiftRight<across>(block);
        const auto before =
            hn::Add(hn::ShiftLeft<parents_across>(hn::ShiftRight<parent>(y)), hn::ShiftRight<parent>(x));
        const auto inside = hn::And(hn::Or(x, y), hn::Set(Wholes(), parent_side / side - 1));
        Traveller a;
        a.pixel = lane_numbers() + whole(static_cast<Int>(from));
        a.ray.t.of[0] = looked_up(Reals(), parents.start + first, before);
        parents.costs.give(a.ray, first, before, inside);
        whole left;
        whole bottom;
        left.of[0] = hn::ShiftLeft<log2_of(side)>(x);
        bottom.of[0] = hn::ShiftLeft<log2_of(side)>(y);
        begin_cones(d, a, middle_of<side>(left + whole(static_cast<Int>(group.left[tile]))),
                    middle_of<side>(bottom + whole(static_cast<Int>(group.bottom[tile]))), first_lanes(register_lanes),
                    cones);
    }
}

// Marches the cones that have begun.
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
            [&](Traveller& a, const mask& stopped) MM_INLINED { store_cones(a, stopped, cones); });
    }
}
