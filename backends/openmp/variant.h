// SPDX-License-Identifier: Apache-2.0
// A variant: the kernel compiled for one fractal, precision, mode, instruction set and pack width. Contains plain data
// only, because translation units for different instruction sets share it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "backends/openmp/neighbours.h"
#include "backends/openmp/ray_pool.h"
#include "core/image/tile.h"

namespace mandelmarch::openmp {

// Destination of the finished pixels of rows [first_row, end_row). Pixels are stored to `bytes`, three per pixel; if
// `bytes` is null, to `reals` and `wholes`, planes with the layout of core/image/image.h.
template <class Real>
struct Canvas {
    int first_row;
    int end_row;
    std::ptrdiff_t pixels;  // per plane
    Real spacing;           // distance of diagonally adjacent rays at distance 1 from the camera
    bool cones;             // subtiles begin with cones
    Real block_hull;        // size of the enlarged hull for subtiles (spacing.h); 0: none
    Lattice lattice;        // pixels to render, counted from first_row
    Real* block_start;      // for each subtile: none of its rays hits before this t
    Real* neighbour_depth;  // of pixels in even columns and rows, at half their index (core/kernel/march.h)
    // Occlusion of the same pixels, at the same places, which the pixels between them share; null: not shared.
    Real* along_normal;
    Real* sunwards;
    Real* reals;
    int* wholes;
    unsigned char* bytes;
};

// Work of all rays rendered. All counts are 0 if the variant does not count.
struct WorkCounts {
    std::uint64_t steps;
    std::uint64_t de_calls;
    std::uint64_t iterations;
};

// Source of tiles for one thread. next() returns false if no tiles are left; otherwise (left, bottom) is the tile's
// first pixel in the picture. No tile is returned twice.
struct Tiles {
    bool (*next)(void* source, int& left, int& bottom);
    void* source;
};

// Renders tiles until none are left. `scene` is the kernel's Scene in Real's layout; `memory` belongs to the thread.
template <class Real>
using DrawTiles = WorkCounts (*)(const void* scene, const Canvas<Real>& canvas, const Tiles& tiles, void* memory);

// Renders tiles like DrawTiles, and adds the seconds of each stage (stage.h), measured with `clock`, to `seconds`.
template <class Real>
using ProfileTiles = void (*)(const void* scene, const Canvas<Real>& canvas, const Tiles& tiles, void* memory,
                              double (*clock)(), double* seconds);

template <class Real>
struct Variant {
    const char* instruction_set;
    int pack;      // pixels rendered at once
    bool counted;  // the variant counts work and can store planes
    DrawTiles<Real> draw;
    std::size_t memory;                    // bytes per thread, aligned to 64
    ProfileTiles<Real> profile = nullptr;  // for the best variant only; renders the same picture as `draw`
    std::size_t profile_memory = 0;
};

// The variants in packs that this machine can run, for one fractal, precision and mode; the best is last.
template <class Real>
struct VariantList {
    static constexpr int most = 8;
    Variant<Real> of[most];
    int count;
};

}  // namespace mandelmarch::openmp
