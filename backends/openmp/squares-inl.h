// SPDX-License-Identifier: Apache-2.0
// Rays begin together at the sites of a square.

// Guard: once for each pack with pools.
#if defined(MM_SITES_INL_H) == defined(MM_POOL_TOGGLE)
#ifdef MM_SITES_INL_H
#undef MM_SITES_INL_H
#else
#define MM_SITES_INL_H
#endif

#include "backends/openmp/blocks-inl.h"
#include "backends/openmp/drawing-inl.h"
#include "backends/openmp/passes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

// Pixels of a square, `across` x `across` of them, `apart` from each other.
struct Sites {
    int left;  // the first pixel
    int bottom;
    int log2_apart;
    int log2_across;
    MM_REAL from[block_pixels + register_lanes];   // no ray hits before; whole registers can be read
    MM_REAL start[block_pixels + register_lanes];  // where rays begin by those around them

    int across() const { return 1 << log2_across; }
    int count() const { return 1 << 2 * log2_across; }
};

// What stands at each lane's place.
template <class D>
HWY_INLINE hn::Vec<D> looked_up(D d, const hn::TFromD<D>* from, hn::Vec<Wholes> places)
{
    return hn::TableLookupLanes(hn::LoadU(d, from), hn::IndicesFromVec(d, places));
}

// The places in the picture of a square's columns or rows.
struct Places {
    MM_REAL at[block_side + register_lanes];  // whole registers can be read

    HWY_INLINE Places(const Sites& sites, int first, int size)
    {
        for (int n = 0; n < sites.across(); n += register_lanes) {
            whole pixels = lane_numbers() + whole(static_cast<Int>(n));
            EACH_REGISTER(pixels.of[u] = hn::ShiftLeftSame(pixels.of[u], sites.log2_apart);)
            store_lanes(picture_place(real_of(pixels + whole(static_cast<Int>(first))), size), at + n);
        }
    }
};

// The sites of a register, row by row, counted from its first one.
struct SiteLanes {
    Int x[register_lanes];
    Int y[register_lanes];
    Int pixel[register_lanes];

    HWY_INLINE SiteLanes(const Sites& sites, int width)
    {
        for (int n = 0; n < register_lanes; ++n) {
            x[n] = static_cast<Int>(n & (sites.across() - 1));
            y[n] = static_cast<Int>(n >> sites.log2_across);
            pixel[n] = (y[n] * width + x[n]) << sites.log2_apart;
        }
    }
};

// Begins the rays of a square's pixels. `painted`: those of blocks where no ray hits are there already.
HWY_NOINLINE void begin_sites(Drawing& d, const Sites& sites, bool painted)
{
    const Scene& scene = d.scene;
    const Places us(sites, sites.left, scene.width);
    const Places vs(sites, sites.bottom, scene.height);
    const SiteLanes lanes(sites, scene.width);
    const whole x = load_lanes(lanes.x);
    const whole y = load_lanes(lanes.y);
    for (int n = 0; n < sites.count(); n += pack_lanes) {
        const int column = n & (sites.across() - 1);
        const int row = n >> sites.log2_across;
        const int x0 = sites.left + (column << sites.log2_apart);
        const int y0 = sites.bottom + (row << sites.log2_apart);
        if (x0 >= scene.width || y0 >= d.canvas.end_row) continue;
        Traveller a;
        a.pixel = load_lanes(lanes.pixel) + whole(static_cast<Int>(y0 - d.canvas.first_row) * scene.width + x0);
        const real from = load_lanes(sites.from + n);
        const real start = load_lanes(sites.start + n);
        // The rows and columns that are left of the picture, in sites.
        const int columns = ((scene.width - 1 - x0) >> sites.log2_apart) + 1;
        const int rows = ((d.canvas.end_row - 1 - y0) >> sites.log2_apart) + 1;
        mask on = x < whole(static_cast<Int>(columns)) && y < whole(static_cast<Int>(rows));
        if (painted) on = on && from <= scene.end;
        real u;
        real v;
        u.of[0] = looked_up(Reals(), us.at + column, x.of[0]);
        v.of[0] = looked_up(Reals(), vs.at + row, y.of[0]);
        a.ray = begin_at(scene, u, v);
        a.ray.t = larger(a.ray.t, from);
        a.ray = begun_between(a.ray, start);
        a.room = scene.end;
        const mask go = marching(scene, a.ray);
        append(d.pools.marching, a, on && go);
        const mask gone = on && !go;
        if (any(gone)) {
            store_pixels(missed(scene, a.ray), a.pixel, gone, d.canvas, d.spent);
            if (d.canvas.lattice.apart > 1) leave(d, a, all_clear(), gone && start > scene.end);
        }
    }
}

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
