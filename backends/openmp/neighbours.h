// SPDX-License-Identifier: Apache-2.0
// Neighbours: the order of a picture's pixels in fast mode. Pixels in columns and rows that are multiples of 4 are
// rendered first, then multiples of 2, then all others; later rays begin near the hits of the earlier pixels around
// them (core/kernel/march.h, neighbour_start()). Plain data, shared with translation units for one instruction set.
#pragma once

namespace mandelmarch::openmp {

// The pixels in columns and rows that are multiples of `apart` (1, 2 or 4) but not of `before`, whose pixels are
// already rendered; before 0: none are.
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

}  // namespace mandelmarch::openmp
