// SPDX-License-Identifier: Apache-2.0
// Neighbours: the order in which fast mode renders a picture's pixels. Pixels whose column and row are multiples of 4
// are rendered first, then those of multiples of 2, then all others. A later ray begins near the hits of the pixels
// around it that are already rendered (core/kernel/march.h, neighbour_start()). Contains plain data only, because
// translation units for different instruction sets share it.
#pragma once

namespace mandelmarch::openmp {

// The pixels whose column and row are multiples of `apart` (1, 2 or 4), without those whose column and row are
// multiples of `before`, which are already rendered. `before` is 0 in the first lattice.
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
