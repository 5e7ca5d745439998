// SPDX-License-Identifier: Apache-2.0
// Neighbours: the order of a picture's pixels in fast mode. Those in columns and rows that are multiples of 4 are drawn
// first, then those of 2, then all others; the rays of the later ones begin near the hits of the earlier ones around
// them (core/kernel/march.h, neighbour_start()). Plain data: it is shared with translation units that are compiled for
// one instruction set.
#pragma once

namespace mandelmarch::openmp {

// The pixels whose column and row are multiples of `apart`, 1, 2 or 4, but not of `before`, whose pixels are drawn
// already; 0: none are.
struct Lattice {
    int before;
    int apart;
};

// The lattices of a picture, in their order.
struct Lattices {
    Lattice of[3];
    int count;

    const Lattice* begin() const { return of; }
    const Lattice* end() const { return of + count; }
};

inline constexpr Lattices all_at_once{{{0, 1}}, 1};

}  // namespace mandelmarch::openmp
