// SPDX-License-Identifier: Apache-2.0
// Begins the rays of a square of pixels of a lattice.

// A square of `across` x `across` pixels of a lattice. In the picture, adjacent pixels of the square are 2^log2_apart
// pixels apart.
struct Square {
    int left;  // column of the first pixel
    int bottom;
    int log2_apart;
    int log2_across;
    // The t at which each pixel's ray can begin, according to its subtile and to its neighbours. Padded, because
    // whole registers are read.
    MM_REAL block_start[block_pixels + register_lanes];
    MM_REAL neighbour_start[block_pixels + register_lanes];

    int across() const { return 1 << log2_across; }
    int count() const { return 1 << 2 * log2_across; }
};

// Returns, for each lane, the element of a table at the lane's index.
template <class D>
HWY_INLINE hn::Vec<D> looked_up(D d, const hn::TFromD<D>* from, hn::Vec<Wholes> places)
{
    return hn::TableLookupLanes(hn::LoadU(d, from), hn::IndicesFromVec(d, places));
}

// Positions of a square's columns or rows in the picture; the picture extends from -1 to 1.
struct PicturePlaces {
    MM_REAL at[subtile_side + register_lanes];  // padded, because whole registers are read

    HWY_INLINE PicturePlaces(const Square& square, int first, int size)
    {
        for (int n = 0; n < square.across(); n += register_lanes) {
            whole pixels = lane_numbers() + whole(static_cast<Int>(n));
            EACH_REGISTER(pixels.of[u] = hn::ShiftLeftSame(pixels.of[u], square.log2_apart);)
            store_lanes(picture_place(real_of(pixels + whole(static_cast<Int>(first))), size), at + n);
        }
    }
};

// Offsets of a register's pixels from its first pixel. The pixels of a square are taken row by row.
struct SquareLanes {
    Int x[register_lanes];
    Int y[register_lanes];
    Int pixel[register_lanes];

    HWY_INLINE SquareLanes(const Square& square, int width)
    {
        for (int n = 0; n < register_lanes; ++n) {
            x[n] = static_cast<Int>(n & (square.across() - 1));
            y[n] = static_cast<Int>(n >> square.log2_across);
            pixel[n] = (y[n] * width + x[n]) << square.log2_apart;
        }
    }
};

// Begins the rays of a square's pixels. If `painted` is true, subtiles that no ray hits are already painted, and their
// pixels are omitted.
HWY_NOINLINE void begin_square(Drawing& d, const Square& square, bool painted)
{
    const Scene& scene = d.scene;
    const PicturePlaces us(square, square.left, scene.width);
    const PicturePlaces vs(square, square.bottom, scene.height);
    const SquareLanes lanes(square, scene.width);
    const whole x = load_lanes(lanes.x);
    const whole y = load_lanes(lanes.y);
    for (int n = 0; n < square.count(); n += pack_lanes) {
        const int column = n & (square.across() - 1);
        const int row = n >> square.log2_across;
        const int x0 = square.left + (column << square.log2_apart);
        const int y0 = square.bottom + (row << square.log2_apart);
        if (x0 >= scene.width || y0 >= d.canvas.end_row) continue;
        RayPack a;
        a.pixel = load_lanes(lanes.pixel) + whole(static_cast<Int>(y0 - d.canvas.first_row) * scene.width + x0);
        const real from = load_lanes(square.block_start + n);
        const real start = load_lanes(square.neighbour_start + n);
        // Numbers of the lattice's columns and rows from (x0, y0) to the band's edges.
        const int columns = ((scene.width - 1 - x0) >> square.log2_apart) + 1;
        const int rows = ((d.canvas.end_row - 1 - y0) >> square.log2_apart) + 1;
        mask on = x < whole(static_cast<Int>(columns)) && y < whole(static_cast<Int>(rows));
        if (painted) on = on && from <= scene.end;
        real u;
        real v;
        u.of[0] = looked_up(Reals(), us.at + column, x.of[0]);
        v.of[0] = looked_up(Reals(), vs.at + row, y.of[0]);
        a.ray = begin_at(scene, u, v);
        a.ray.t = larger(a.ray.t, from);
        a.ray = begun_by_neighbours(a.ray, start);
        a.room = scene.end;
        const mask go = marching(scene, a.ray);
        append(d.pools.marching, a, on && go);
        const mask gone = on && !go;
        if (any(gone)) {
            store_pixels(missed(scene, stopped(scene, a.ray)), a.pixel, gone, d.canvas, d.spent);
            if (d.canvas.lattice.apart > 1) leave_depths(d, a, clear_miss(), gone && start > scene.end);
        }
    }
}
