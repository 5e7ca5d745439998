// Cones before rays: how far the rays of a block of pixels can go together. Included by pool.h, in its namespace; no
// guard.

// A pack's values, lane by lane.
struct Lanes {
    MM_REAL i[pack_lanes];
    MM_REAL j[pack_lanes];
    MM_REAL start[pack_lanes];  // no ray hits before this t
    Int estimates[pack_lanes];  // made for it by cones
    Int iterations[pack_lanes];
};

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

// Where a group's cones came to. What a cone cost is counted for one of its rays.
template <int side>
struct Cones {
    static constexpr int most = group_tiles * blocks_of_tile(side) + register_lanes;  // whole registers can be read
    MM_REAL start[most];
    Int estimates[most];
    Int iterations[most];
};

// Where the cones that are on have come to, to their places.
template <int side>
HWY_NOINLINE void store_cones(const Traveller& a, const mask& on, Cones<side>& cones)
{
    constexpr int room = pack_lanes + register_lanes;
    Int at[room];
    MM_REAL t[room];
    Int work[2][room];
    store_compact(a.pixel, on, at);
    store_compact(a.ray.t, on, t);
    store_compact(a.ray.estimates, on, work[0]);
    store_compact(a.ray.iterations, on, work[1]);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) {
        cones.start[at[i]] = t[i];
        cones.estimates[at[i]] = work[0][i];
        cones.iterations[at[i]] = work[1][i];
    }
}

// Begins one cone for every block of `side` pixels, where the larger block's cone came to.
template <int side, int parent_side>
HWY_NOINLINE void begin_cones(Drawing& d, const Group& group, const Cones<parent_side>* parents, Cones<side>& cones)
{
    const int blocks = group.count * blocks_of_tile(side);
    for (int from = 0; from < blocks; from += pack_lanes) {
        Lanes lanes;
        for (int lane = 0; lane < pack_lanes; ++lane) {
            const int block = from + lane < blocks ? from + lane : blocks - 1;
            const int tile = block / blocks_of_tile(side);
            const int x = block % blocks_of_tile(side) % blocks_across(side) * side;
            const int y = block % blocks_of_tile(side) / blocks_across(side) * side;
            constexpr MM_REAL middle = MM_REAL(0.5) * (side - 1);
            lanes.i[lane] = static_cast<MM_REAL>(group.left[tile] + x) + middle;
            lanes.j[lane] = static_cast<MM_REAL>(group.bottom[tile] + y) + middle;
            const int parent =
                tile * blocks_of_tile(parent_side) + y / parent_side * blocks_across(parent_side) + x / parent_side;
            const bool first = x % parent_side == 0 && y % parent_side == 0;
            lanes.start[lane] = parents == nullptr ? MM_REAL(0) : parents->start[parent];
            lanes.estimates[lane] = parents == nullptr || !first ? Int(0) : parents->estimates[parent];
            lanes.iterations[lane] = parents == nullptr || !first ? Int(0) : parents->iterations[parent];
        }
        Traveller a;
        a.pixel = lane_numbers() + whole(static_cast<Int>(from));
        a.ray = begin(d.scene, load_lanes(lanes.i), load_lanes(lanes.j));
        // A ray at the cone's edge may meet the hull before the axis does. An axis that misses it goes nowhere.
        a.ray.t = load_lanes(lanes.start);
        a.ray.estimates = load_lanes(lanes.estimates);
        a.ray.iterations = load_lanes(lanes.iterations);
        const mask on = first_lanes(blocks - from);
        const mask go = on && a.ray.t <= a.ray.end;
        append(d.pools.cones, a, go);
        if (any(on && !go)) store_cones(a, on && !go, cones);
    }
}

// Marches a cone for every block of `side` pixels.
template <int side, int parent_side>
HWY_NOINLINE void march_cones(Drawing& d, const Group& group, const Cones<parent_side>* parents, Cones<side>& cones)
{
    const scalar span = d.canvas.pitch * (MM_REAL(0.5) * (side - 1));
    Pool& pool = d.pools.cones;
    pool.size = 0;
    begin_cones(d, group, parents, cones);
    while (pool.size > 0) {
        sample_pool(
            d, pool, steps_at_once,
            [&](Ray& ray, const Estimate& here, const mask& on) MM_INLINED {
                ray = advanced_cone(d.scene, ray, span, here, on);
                return on && cone_goes(ray);
            },
            [&](Traveller& a, const mask& stopped) MM_INLINED { store_cones(a, stopped, cones); });
    }
}
