// Rays begin: the tiles of a group, and their cones before them. Included by pool.h, in its namespace; no guard.

// A register covers a rectangle of pixels in a square of 8 x 8, so that the rays of a pack stay close to each other.
constexpr int square_side = 8;
constexpr int across_lanes = register_lanes < square_side ? register_lanes : square_side;
constexpr int up_lanes = register_lanes / across_lanes;
static_assert(tile_side % square_side == 0 && square_side % up_lanes == 0);

HWY_INLINE whole lane_across()
{
    whole a = lane_numbers();
    EACH_REGISTER(a.of[u] = hn::And(a.of[u], hn::Set(Wholes(), across_lanes - 1));)
    return a;
}

HWY_INLINE whole lane_up()
{
    whole a = lane_numbers();
    EACH_REGISTER(a.of[u] = hn::ShiftRight<log2_of(across_lanes)>(a.of[u]);)
    return a;
}

// The places in the picture of a tile's columns or rows, from `first` on.
struct Places {
    MM_REAL at[tile_side + register_lanes];  // whole registers can be read

    HWY_INLINE Places(int first, int size)
    {
        for (int n = 0; n < tile_side; n += register_lanes) {
            store_lanes(picture_place(real_of(lane_numbers() + whole(static_cast<Int>(first + n))), size), at + n);
        }
    }
};

// Rays of a rectangle, (x, y) its first pixel in the tile, after the cones of their blocks. What a cone cost is counted
// for one of its rays.
HWY_INLINE Ray after_cones(Ray ray, const Cones<2>& cones, int tile, int x, int y)
{
    const whole across = lane_across();
    const whole up = lane_up() + whole(static_cast<Int>(y));
    const int first = tile * blocks_of_tile(2) + y / 2 * blocks_across(2) + x / 2;
    EACH_REGISTER(const auto blocks = hn::ShiftRight<1>(across.of[u]);
                  const auto odd = hn::And(hn::Or(across.of[u], up.of[u]), hn::Set(Wholes(), 1));
                  const auto start = looked_up(Reals(), cones.start + first, blocks);
                  ray.t.of[u] = hn::Max(ray.t.of[u], start); cones.costs.give(ray, first, blocks, odd);)
    return ray;
}

// Begins the rays of tile number `tile` of the group, where its cones of 2 x 2 pixels came to, if there are any.
HWY_NOINLINE void begin_tile(Drawing& d, const Group& group, int tile, const Cones<2>* cones)
{
    const Scene& scene = d.scene;
    Int places[pack_lanes];
    for (int n = 0; n < pack_lanes; ++n) {
        places[n] = static_cast<Int>(n / across_lanes) * scene.width + n % across_lanes;
    }
    const Places us(group.left[tile], scene.width);
    const Places vs(group.bottom[tile], scene.height);
    for (int n = 0; n < tile_pixels; n += pack_lanes) {
        // Squares, and their rectangles, in rows.
        const int square = n / (square_side * square_side);
        const int rectangle = n % (square_side * square_side) / pack_lanes;
        constexpr int rectangles_across = square_side / across_lanes;
        constexpr int squares_across = tile_side / square_side;
        const int x = square % squares_across * square_side + rectangle % rectangles_across * across_lanes;
        const int y = square / squares_across * square_side + rectangle / rectangles_across * up_lanes;
        const int x0 = group.left[tile] + x;
        const int y0 = group.bottom[tile] + y;
        if (x0 >= scene.width || y0 >= d.canvas.end_row) continue;
        const real i = real_of(lane_across() + whole(static_cast<Int>(x0)));
        const real j = real_of(lane_up() + whole(static_cast<Int>(y0)));
        Traveller a;
        a.pixel = load_lanes(places) + whole(static_cast<Int>(y0 - d.canvas.first_row) * scene.width + x0);
        const mask on = i < scene.width && j < d.canvas.end_row;
        real u;
        real v;
        u.of[0] = looked_up(Reals(), us.at + x, lane_across().of[0]);
        v.of[0] = looked_up(Reals(), vs.at + y, lane_up().of[0]);
        a.ray = begin_at(scene, u, v);
        if (cones != nullptr) a.ray = after_cones(a.ray, *cones, tile, x, y);
        const mask go = marching(scene, a.ray);
        append(d.pools.marching, a, on && go);
        if (any(on && !go)) store_pixels(missed(scene, a.ray), a.pixel, on && !go, d.canvas, d.spent);
    }
}

// Begins a group's tiles, with cones of 8 and of 2 pixels before the rays.
HWY_NOINLINE void begin_group(Drawing& d, const Group& group)
{
    Cones<8> coarse;
    Cones<2> fine;
    const bool with_cones = d.canvas.pitch > 0;
    if (with_cones) {
        begin_all_cones(d, group, coarse);
        march_cones(d, coarse);
        begin_all_cones(d, group, coarse, fine);
        march_cones(d, fine);
    }
    for (int tile = 0; tile < group.count; ++tile) begin_tile(d, group, tile, with_cones ? &fine : nullptr);
}

// Begins tiles while the pool has room for a group; false when there are no more.
HWY_NOINLINE bool begin_tiles(Drawing& d)
{
    bool more = true;
    while (more && d.pools.marching.size <= pool_rays - group_tiles * tile_pixels) {
        Group group;
        group.count = 0;
        while (group.count < group_tiles && more) {
            more = d.tiles.next(d.tiles.source, group.left[group.count], group.bottom[group.count]);
            group.count += more ? 1 : 0;
        }
        if (group.count > 0) begin_group(d, group);
    }
    return more;
}
