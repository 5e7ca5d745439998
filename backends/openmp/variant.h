// SPDX-License-Identifier: Apache-2.0
// A variant: the kernel text compiled for one fractal, precision, mode, instruction set and pack width. Plain data: it
// is shared with translation units that are compiled for one instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "backends/openmp/neighbours.h"
#include "backends/openmp/ray_pool.h"
#include "core/image/tile.h"

namespace mandelmarch::openmp {

// Where finished pixels of rows [first_row, end_row) of the picture go: to `bytes`, three a pixel, or, where that is
// null, to planes as core/image/image.h lays them out.
template <class Real>
struct Canvas {
    int first_row;
    int end_row;
    std::ptrdiff_t pixels;  // of a plane
    Real spacing;           // how far diagonal neighbours' rays are apart at distance 1
    bool cones;             // whether blocks begin with cones
    Real block_hull;        // the middle ray of a block meets it where a ray of the block meets the scene's; 0: none
    Lattice lattice;        // its pixels are drawn, counted from first_row
    Real* block_start;      // for each block: no ray of it hits before
    Real* neighbour_depth;  // of the pixels in even columns and rows, at half their number (core/kernel/march.h)
    // A look's Surroundings of these pixels, likewise, which those between them share; null: each pixel finds its own.
    Real* along_normal;
    Real* sunwards;
    Real* reals;
    int* wholes;
    unsigned char* bytes;
};

// The work of all rays drawn; 0 where nobody counted.
struct Spent {
    std::uint64_t steps;
    std::uint64_t estimates;
    std::uint64_t iterations;
};

// Hands out tiles, each once, to whichever thread asks: (left, bottom) is a tile's first pixel in the picture.
struct Tiles {
    bool (*next)(void* source, int& left, int& bottom);
    void* source;
};

// Draws tiles until there are no more. `scene` is the kernel text's Scene in Real's layout; `memory` belongs to the
// thread.
template <class Real>
using DrawTiles = Spent (*)(const void* scene, const Canvas<Real>& canvas, const Tiles& tiles, void* memory);

// The same with a clock between the stages, in seconds; adds those of each stage (stage.h) to `seconds`.
template <class Real>
using ProfileTiles = void (*)(const void* scene, const Canvas<Real>& canvas, const Tiles& tiles, void* memory,
                              double (*clock)(), double* seconds);

template <class Real>
struct Variant {
    const char* instruction_set;
    int pack;      // pixels at once
    bool counted;  // whether it counts work and can store planes
    DrawTiles<Real> draw;
    std::size_t memory;                    // bytes that each thread needs, aligned to 64
    ProfileTiles<Real> profile = nullptr;  // the best variant's; it has the picture of `draw`
    std::size_t profile_memory = 0;
};

// Every variant in packs of one fractal, precision and mode that this machine can run, the best last.
template <class Real>
struct VariantList {
    static constexpr int most = 8;
    Variant<Real> of[most];
    int count;
};

}  // namespace mandelmarch::openmp
