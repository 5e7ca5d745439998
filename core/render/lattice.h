// SPDX-License-Identifier: Apache-2.0
// Lattices of pixels, and where their rays begin. Contains plain data only, because translation units that are compiled
// for one instruction set include it.
#pragma once

namespace mandelmarch {

// Fast mode may render the pixels of a band in up to three lattices: first the pixels whose column and row are
// multiples of 4, then those whose column and row are multiples of 2, then all others. A later ray begins near the hits
// of its neighbours, which are the rendered pixels around it (neighbour_start() in core/kernel/stepping.h).

// The pixels whose column and row are multiples of `apart` (1, 2 or 4), without those whose column and row are
// multiples of `before`, which are already rendered. `before` is 0 in the first lattice. Rows are counted from the
// band's first row.
struct Lattice {
    int before;
    int apart;
};

// The lattices of a picture, in rendering order.
struct Lattices {
    Lattice of[3];
    int count;

    const Lattice* begin() const { return of; }
    const Lattice* end() const { return of + count; }
};

inline constexpr Lattices all_at_once{{{0, 1}}, 1};

inline constexpr int gpu_cone_side = 4;  // pixels; side of the tiles with cones on GPUs without neighbours
inline constexpr int subtile_side = 8;   // pixels; max side of a tile whose rays begin at the end of one cone

// The cones of a band: one around the rays of each tile of side x side pixels, counted from the band's first row. They
// begin where the cones of the tiles of within x within pixels around them ended; 0: at the hull.
struct Cones {
    int side;
    int within;
};

// The passes of a picture that find where its rays begin.
struct Starts {
    Cones cones[2] = {};  // in marching order
    int cone_passes = 0;
    Lattices lattices = all_at_once;

    // Returns the side of the tiles at whose cones the rays begin; 0: there are no cones.
    int tile_side() const { return cone_passes > 0 ? cones[cone_passes - 1].side : 0; }
};

// Returns true if a picture has cones or several lattices. Its pixels then depend on the rows of its bands.
constexpr bool has_starts(const Starts& starts) { return starts.cone_passes > 0 || starts.lattices.count > 1; }

// Returns the number of tiles with the given side in a row or column of `pixels` pixels.
constexpr int tiles_along(int pixels, int side) { return (pixels + side - 1) / side; }

// Returns the number of tiles with the given side in width x rows pixels.
constexpr int tiles_of(int width, int rows, int side) { return tiles_along(width, side) * tiles_along(rows, side); }

// The pixels of a lattice lie in cells of cell_side() x cell_side() pixels. A cell has places_of_cell() of them: the
// first lattice's lie at the cells' lower left corners; those of later lattices lie around these corners.
constexpr int cell_side(Lattice lattice) { return lattice.before > 0 ? lattice.before : lattice.apart; }
constexpr int places_of_cell(Lattice lattice) { return lattice.before > 0 ? 3 : 1; }

}  // namespace mandelmarch
