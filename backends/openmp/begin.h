// Rays begin: the blocks of some tiles, and their cones before them. Included by pool.h, in its namespace; no guard.

// A register covers a rectangle of a block's pixels, so that the rays of a pack stay close to each other.
constexpr int across_lanes = register_lanes < block_side ? register_lanes : block_side;
constexpr int up_lanes = register_lanes / across_lanes;
static_assert(tile_side % block_side == 0 && block_side % up_lanes == 0);

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

// The places in the picture of a block's columns or rows, from `first` on.
struct Places {
    MM_REAL at[block_side + register_lanes];  // whole registers can be read

    HWY_INLINE Places(Int first, int size)
    {
        for (int n = 0; n < block_side; n += register_lanes) {
            store_lanes(picture_place(real_of(lane_numbers() + whole(static_cast<Int>(first + n))), size), at + n);
        }
    }
};

// Rays of a rectangle, (x, y) its first pixel in the block, after the fine cones from number `first` on. What a cone
// cost is counted for one of its rays.
HWY_INLINE Ray after_cones(Ray ray, const FineCones& cones, int first, int x, int y)
{
    const whole across = lane_across();
    const whole up = lane_up() + whole(static_cast<Int>(y));
    const int row = first + y / fine_side * fine_across + x / fine_side;
    EACH_REGISTER(const auto at = hn::ShiftRight<1>(across.of[u]);
                  const auto odd = hn::And(hn::Or(across.of[u], up.of[u]), hn::Set(Wholes(), 1));
                  const auto start = looked_up(Reals(), cones.start + row, at);
                  ray.t.of[u] = hn::Max(ray.t.of[u], start); cones.costs.give(ray, row, at, odd);)
    return ray;
}

// Begins the rays of a block, where its fine cones came to, if there are any.
HWY_NOINLINE void begin_block(Drawing& d, const Blocks& blocks, int block, const FineCones* cones)
{
    const Scene& scene = d.scene;
    const Places us(blocks.left[block], scene.width);
    const Places vs(blocks.bottom[block], scene.height);
    Int places[pack_lanes];
    for (int n = 0; n < pack_lanes; ++n) {
        places[n] = static_cast<Int>(n / across_lanes) * scene.width + n % across_lanes;
    }
    for (int n = 0; n < block_pixels; n += pack_lanes) {
        const int rectangle = n / pack_lanes;
        constexpr int rectangles_across = block_side / across_lanes;
        const int x = rectangle % rectangles_across * across_lanes;
        const int y = rectangle / rectangles_across * up_lanes;
        const int x0 = static_cast<int>(blocks.left[block]) + x;
        const int y0 = static_cast<int>(blocks.bottom[block]) + y;
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
        if (cones != nullptr) a.ray = after_cones(a.ray, *cones, block * fine_cones, x, y);
        const mask go = marching(scene, a.ray);
        append(d.pools.marching, a, on && go);
        if (any(on && !go)) store_pixels(missed(scene, a.ray), a.pixel, on && !go, d.canvas, d.spent);
    }
}

// Paints the blocks that no ray of can hit anything, and forgets them.
HWY_NOINLINE void paint_background(Drawing& d, Blocks& blocks, BlockCones& cones)
{
    const PaintedRow row(missed(d.scene, begin_at(d.scene, 0, 0)).colour);
    const int count = blocks.count;
    blocks.count = 0;
    for (int block = 0; block < count; ++block) {
        if (cones.start[block] > d.scene.end) {
            paint(d, blocks.left[block], blocks.bottom[block], row);
            cones.costs.add_to(d.spent, block);
        } else {
            const int to = blocks.count++;
            blocks.left[to] = blocks.left[block];
            blocks.bottom[to] = blocks.bottom[block];
            cones.start[to] = cones.start[block];
            cones.costs.move(to, block);
        }
    }
}

// Begins the rays of some blocks, after their cones if there are any. A block's cone tells also whether a ray of it can
// meet the hull at all.
HWY_NOINLINE void begin_blocks(Drawing& d, Blocks& blocks)
{
    BlockCones coarse;
    FineCones fine;
    const bool with_cones = d.canvas.pitch > 0;
    const bool paints = paints_background(d);
    if (with_cones || paints) begin_block_cones(d, blocks, coarse);
    if (with_cones) march_cones(d, coarse);
    d.pools.cones.size = 0;
    if (paints) paint_background(d, blocks, coarse);
    if (with_cones) {
        begin_fine_cones(d, blocks, coarse, fine);
        march_cones(d, fine);
    }
    for (int block = 0; block < blocks.count; ++block) begin_block(d, blocks, block, with_cones ? &fine : nullptr);
}

// Begins tiles while the pool has room for them; false when there are no more.
HWY_NOINLINE bool begin_tiles(Drawing& d)
{
    bool more = true;
    while (more && d.pools.marching.size <= pool_rays - most_blocks * block_pixels) {
        Blocks blocks;
        more = take_tiles(d, blocks);
        if (blocks.count > 0) begin_blocks(d, blocks);
    }
    return more;
}
