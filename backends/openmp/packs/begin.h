// SPDX-License-Identifier: Apache-2.0
// Begins the rays of tiles. Before that, a cone around the rays of each subtile is marched (cones.h).

constexpr int log2_of(int n) { return n == 1 ? 0 : 1 + log2_of(n / 2); }

// Called for a band's first lattice. Stores in Canvas::block_start the t at which the cone of each subtile ends. Fills
// subtiles without hits with the background's colour.
HWY_NOINLINE void begin_blocks(Drawing& d, const Blocks& blocks)
{
    const bool paints = paints_background(d);
    if (!paints && !d.canvas.cones) {
        for (int block = 0; block < blocks.count; ++block) d.canvas.block_start[blocks.number[block]] = 0;
        return;
    }
    begin_cones(d, blocks);
    march_cone_pool(d);
    if (!paints) return;
    const PaintedRow row(missed(d.scene, stopped(d.scene, begin_at(d.scene, 0, 0))).colour);
    for (int block = 0; block < blocks.count; ++block) {
        if (d.canvas.block_start[blocks.number[block]] > d.scene.end)
            paint(d, blocks.left[block], blocks.bottom[block], row);
    }
}

// Depths of the pixels at the corners of a square's cells, row by row. The pixels at the corners are rendered before
// those inside the cells. A side of the square has `across` cells and one more corner. Corners outside the band have
// the depth unclear_miss().
template <int across>
struct Neighbours {
    MM_REAL at[across + 1][across + 1];

    HWY_INLINE Neighbours(const Drawing& d, int left, int bottom)
    {
        const int apart = d.canvas.lattice.before;
        const int columns = (d.scene.width - 1 - left) / apart + 1;
        const int rows = (d.canvas.end_row - 1 - bottom) / apart + 1;
        for (int j = 0; j <= across; ++j) {
            const std::ptrdiff_t row = std::ptrdiff_t{bottom + j * apart - d.canvas.first_row} * d.scene.width + left;
            for (int i = 0; i <= across; ++i) {
                at[j][i] = i < columns && j < rows ? d.canvas.neighbour_depth[(row + i * apart) / 2] : unclear_miss();
            }
        }
    }
};

// Computes the t at which the rays in a square's cells begin, from the depths of the pixels at the cells' corners.
template <int across>
HWY_NOINLINE void find_neighbour_starts(const Drawing& d, int left, int bottom, MM_REAL* start)
{
    const Neighbours<across> neighbours(d, left, bottom);
    MM_REAL least[block_pixels];
    MM_REAL greatest[block_pixels];
    const auto less = [](MM_REAL a, MM_REAL b) { return a < b ? a : b; };
    const auto more = [](MM_REAL a, MM_REAL b) { return a < b ? b : a; };
    for (int j = 0; j < across; ++j) {
        const MM_REAL* a = neighbours.at[j];
        const MM_REAL* b = neighbours.at[j + 1];
        for (int i = 0; i < across; ++i) {
            least[j * across + i] = less(less(a[i], a[i + 1]), less(b[i], b[i + 1]));
            greatest[j * across + i] = more(more(a[i], a[i + 1]), more(b[i], b[i + 1]));
        }
    }
    for (int n = 0; n < across * across; n += pack_lanes) {
        store_lanes(neighbour_start(d.scene, load_lanes(least + n), load_lanes(greatest + n)), start + n);
    }
}

// Copies the start of each subtile in a square (Canvas::block_start) to all of the subtile's pixels in the square.
// Returns true if no ray of these subtiles can hit.
HWY_INLINE bool find_block_starts(const Drawing& d, int left, int bottom, Square& square)
{
    const int side = square.across() << square.log2_apart;
    const int log2_pixels = log2_of(subtile_side) - square.log2_apart;  // log2 of the pixels on a subtile's side
    bool all_gone = true;
    for (int y = 0; y < side && bottom + y < d.canvas.end_row; y += subtile_side) {
        for (int x = 0; x < side && left + x < d.scene.width; x += subtile_side) {
            const MM_REAL start = d.canvas.block_start[block_number(d, left + x, bottom + y)];
            all_gone = all_gone && start > d.scene.end;
            MM_REAL* to =
                square.block_start + ((y >> square.log2_apart) << square.log2_across) + (x >> square.log2_apart);
            for (int j = 0; j < 1 << log2_pixels; ++j) {
                for (int i = 0; i < 1 << log2_pixels; ++i) to[(j << square.log2_across) + i] = start;
            }
        }
    }
    return all_gone;
}

// Begins the rays of those pixels of a tile that belong to the canvas's lattice.
HWY_NOINLINE void begin_tile(Drawing& d, int left, int bottom)
{
    const Lattice lattice = d.canvas.lattice;
    const bool painted = paints_background(d);
    const int apart = lattice.before > 0 ? lattice.before : lattice.apart;
    Square square;
    square.log2_apart = log2_of(apart);
    square.log2_across = apart == 4 ? 2 : 3;
    const int side = square.across() << square.log2_apart;
    for (int n = 0; n < square.count(); ++n) square.neighbour_start[n] = 0;
    for (int y = bottom; y < bottom + tile_side && y < d.canvas.end_row; y += side) {
        for (int x = left; x < left + tile_side && x < d.scene.width; x += side) {
            if (find_block_starts(d, x, y, square) && painted) continue;
            if (lattice.before == 4) find_neighbour_starts<4>(d, x, y, square.neighbour_start);
            if (lattice.before == 2) find_neighbour_starts<8>(d, x, y, square.neighbour_start);
            // A later lattice consists of the three pixels of each cell that are not at its lower left corner, since
            // the pixels at the corners are already rendered.
            for (int k = lattice.before > 0 ? 1 : 0; k < (lattice.before > 0 ? 4 : 1); ++k) {
                square.left = x + k % 2 * lattice.apart;
                square.bottom = y + k / 2 * lattice.apart;
                begin_square(d, square, painted);
            }
        }
    }
}

// Called before a band's first lattice. Sets the depths of the subtiles' pixels to unclear_miss() or, in subtiles that
// no ray hits, to clear_miss().
HWY_INLINE void clear_neighbours(const Drawing& d, const Blocks& blocks)
{
    for (int block = 0; block < blocks.count; ++block) {
        const MM_REAL depth = d.canvas.block_start[blocks.number[block]] > d.scene.end ? clear_miss() : unclear_miss();
        const int left = static_cast<int>(blocks.left[block]);
        const int bottom = static_cast<int>(blocks.bottom[block]);
        for (int y = bottom; y < bottom + subtile_side && y < d.canvas.end_row; y += 2) {
            MM_REAL* row =
                d.canvas.neighbour_depth + (std::ptrdiff_t{y - d.canvas.first_row} * d.scene.width + left) / 2;
            for (int x = 0; x < subtile_side / 2 && left + 2 * x < d.scene.width; ++x) row[x] = depth;
        }
    }
}

// Begins tiles while the pool has room for their rays. Returns false if no tiles are left.
HWY_NOINLINE bool begin_tiles(Drawing& d)
{
    bool more = true;
    while (more && d.pools.marching.size <= pool_rays - most_blocks * block_pixels) {
        Blocks blocks;
        more = take_tiles(d, blocks);
        if (d.canvas.lattice.before == 0) begin_blocks(d, blocks);
        if (d.canvas.lattice.before == 0 && d.canvas.lattice.apart > 1) clear_neighbours(d, blocks);
        for (int tile = 0; tile < blocks.tiles; ++tile) begin_tile(d, blocks.tile_left[tile], blocks.tile_bottom[tile]);
    }
    return more;
}
