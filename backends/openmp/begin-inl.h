// SPDX-License-Identifier: Apache-2.0
// Rays begin: those of some tiles, after the cones of their blocks.

// Guard: once for each pack with pools.
#if defined(MM_BEGIN_INL_H) == defined(MM_POOL_TOGGLE)
#ifdef MM_BEGIN_INL_H
#undef MM_BEGIN_INL_H
#else
#define MM_BEGIN_INL_H
#endif

#include <cstddef>

#include "backends/openmp/blocks-inl.h"
#include "backends/openmp/cones-inl.h"
#include "backends/openmp/drawing-inl.h"
#include "backends/openmp/sites-inl.h"
#include "core/image/tile.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

constexpr int log2_of(int n) { return n == 1 ? 0 : 1 + log2_of(n / 2); }

// Where cones of blocks end, to Canvas::starts, for the first call of a picture; and paints the blocks where no ray
// hits.
HWY_NOINLINE void begin_blocks(Drawing& d, const Blocks& blocks)
{
    const bool paints = paints_background(d);
    if (!paints && !d.canvas.cones) {
        for (int block = 0; block < blocks.count; ++block) d.canvas.starts[blocks.number[block]] = 0;
        return;
    }
    begin_cones(d, blocks);
    march_cones(d);
    if (!paints) return;
    const PaintedRow row(missed(d.scene, stopped(d.scene, begin_at(d.scene, 0, 0))).colour);
    for (int block = 0; block < blocks.count; ++block) {
        if (d.canvas.starts[blocks.number[block]] > d.scene.end)
            paint(d, blocks.left[block], blocks.bottom[block], row);
    }
}

// What its lattice has left of a square's corners, row by row, one more than it has cells; nothing outside the picture.
template <int across>
struct Corners {
    MM_REAL at[across + 1][across + 1];

    HWY_INLINE Corners(const Drawing& d, int left, int bottom)
    {
        const int apart = d.canvas.lattice.before;
        const int columns = (d.scene.width - 1 - left) / apart + 1;
        const int rows = (d.canvas.end_row - 1 - bottom) / apart + 1;
        for (int j = 0; j <= across; ++j) {
            const std::ptrdiff_t row = std::ptrdiff_t{bottom + j * apart - d.canvas.first_row} * d.scene.width + left;
            for (int i = 0; i <= across; ++i) {
                at[j][i] = i < columns && j < rows ? d.canvas.hits[(row + i * apart) / 2] : 0;
            }
        }
    }
};

// Where the rays in the cells of a square may begin.
template <int across>
HWY_NOINLINE void start_between_corners(const Drawing& d, int left, int bottom, MM_REAL* start)
{
    const Corners<across> corners(d, left, bottom);
    MM_REAL first[block_pixels];
    MM_REAL last[block_pixels];
    const auto less = [](MM_REAL a, MM_REAL b) { return a < b ? a : b; };
    const auto more = [](MM_REAL a, MM_REAL b) { return a < b ? b : a; };
    for (int j = 0; j < across; ++j) {
        const MM_REAL* a = corners.at[j];
        const MM_REAL* b = corners.at[j + 1];
        for (int i = 0; i < across; ++i) {
            first[j * across + i] = less(less(a[i], a[i + 1]), less(b[i], b[i + 1]));
            last[j * across + i] = more(more(a[i], a[i + 1]), more(b[i], b[i + 1]));
        }
    }
    for (int n = 0; n < across * across; n += pack_lanes) {
        store_lanes(start_between(d.scene, load_lanes(first + n), load_lanes(last + n)), start + n);
    }
}

// Where the blocks of a tile begin, for the sites of a square.
HWY_INLINE bool starts_of(const Drawing& d, int left, int bottom, Sites& sites)
{
    const int side = sites.across() << sites.log2_apart;
    const int log2_sites = log2_of(block_side) - sites.log2_apart;  // of a block
    bool all_gone = true;
    for (int y = 0; y < side && bottom + y < d.canvas.end_row; y += block_side) {
        for (int x = 0; x < side && left + x < d.scene.width; x += block_side) {
            const MM_REAL start = d.canvas.starts[block_number(d, left + x, bottom + y)];
            all_gone = all_gone && start > d.scene.end;
            MM_REAL* to = sites.from + ((y >> sites.log2_apart) << sites.log2_across) + (x >> sites.log2_apart);
            for (int j = 0; j < 1 << log2_sites; ++j) {
                for (int i = 0; i < 1 << log2_sites; ++i) to[(j << sites.log2_across) + i] = start;
            }
        }
    }
    return all_gone;
}

// Begins the rays of a tile's pixels that are in the canvas's lattice.
HWY_NOINLINE void begin_tile(Drawing& d, int left, int bottom)
{
    const Lattice lattice = d.canvas.lattice;
    const bool painted = paints_background(d);
    const int apart = lattice.before > 0 ? lattice.before : lattice.apart;
    Sites sites;
    sites.log2_apart = log2_of(apart);
    sites.log2_across = apart == 4 ? 2 : 3;
    const int side = sites.across() << sites.log2_apart;
    for (int n = 0; n < sites.count(); ++n) sites.start[n] = 0;
    for (int y = bottom; y < bottom + tile_side && y < d.canvas.end_row; y += side) {
        for (int x = left; x < left + tile_side && x < d.scene.width; x += side) {
            if (starts_of(d, x, y, sites) && painted) continue;
            if (lattice.before == 4) start_between_corners<4>(d, x, y, sites.start);
            if (lattice.before == 2) start_between_corners<8>(d, x, y, sites.start);
            // Those at the corners of the cells of `before` pixels are there.
            for (int k = lattice.before > 0 ? 1 : 0; k < (lattice.before > 0 ? 4 : 1); ++k) {
                sites.left = x + k % 2 * lattice.apart;
                sites.bottom = y + k / 2 * lattice.apart;
                begin_sites(d, sites, painted);
            }
        }
    }
}

// A picture's first lattice: nothing is left yet but that where a block is painted all is clear.
HWY_INLINE void clear_hits(const Drawing& d, const Blocks& blocks)
{
    const MM_REAL clear = hn::GetLane(all_clear().of[0]);
    for (int block = 0; block < blocks.count; ++block) {
        const MM_REAL what = d.canvas.starts[blocks.number[block]] > d.scene.end ? clear : 0;
        const int left = static_cast<int>(blocks.left[block]);
        const int bottom = static_cast<int>(blocks.bottom[block]);
        for (int y = bottom; y < bottom + block_side && y < d.canvas.end_row; y += 2) {
            MM_REAL* row = d.canvas.hits + (std::ptrdiff_t{y - d.canvas.first_row} * d.scene.width + left) / 2;
            for (int x = 0; x < block_side / 2 && left + 2 * x < d.scene.width; ++x) row[x] = what;
        }
    }
}

// Begins tiles while the pool has room for them; false when there are no more.
HWY_NOINLINE bool begin_tiles(Drawing& d)
{
    bool more = true;
    while (more && d.pools.marching.size <= pool_rays - most_blocks * block_pixels) {
        Blocks blocks;
        more = take_tiles(d, blocks);
        if (d.canvas.lattice.before == 0) begin_blocks(d, blocks);
        if (d.canvas.lattice.before == 0 && d.canvas.lattice.apart > 1) clear_hits(d, blocks);
        for (int tile = 0; tile < blocks.tiles; ++tile) begin_tile(d, blocks.tile_left[tile], blocks.tile_bottom[tile]);
    }
    return more;
}

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
