// SPDX-License-Identifier: Apache-2.0
// A variant: the kernel compiled for one fractal, precision, mode, instruction set and pack width. This file also has
// the types that variants share. The file contains plain data only, because translation units for different instruction
// sets include it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/image/tile.h"
#include "core/render/kernel_scene.h"
#include "core/render/lattice.h"

namespace mandelmarch::openmp {

constexpr int pool_rays = 4096;  // large enough for few gaps in packs, small enough for a core's cache
constexpr int most_lanes = 64;   // per pack

// A pool of rays, as a structure of arrays, shared by code of several pack widths.
template <class Real>
struct RayPool {
    using Whole = std::conditional_t<std::is_same_v<Real, float>, std::int32_t, std::int64_t>;

    static constexpr int reals = 11;
    static constexpr int wholes = 4;
    static constexpr int room = pool_rays + 2 * most_lanes;
    Real real_fields[reals][room];
    Whole whole_fields[wholes][room];
    int size;
};

// Destination of the finished pixels of rows [first_row, end_row). Pixels are stored to `bytes`, three per pixel; if
// `bytes` is null, to `reals` and `wholes`, planes with the layout of core/image/image.h.
template <class Real>
struct Canvas {
    int first_row;
    int end_row;
    std::ptrdiff_t pixels;  // per plane
    bool cones;             // subtiles begin with cones (packs/cones.h)
    Lattice lattice;        // pixels to render, counted from first_row
    Real* block_start;      // for each subtile, a t before which none of its rays hits
    Real* neighbour_depth;  // depths of the pixels in even columns and rows, at half the pixel's index
    // Occlusion at the hits of the same pixels, at the same indices. The pixels in between share this occlusion. null:
    // not shared.
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

// Renders tiles until none are left. `memory` belongs to the thread.
template <class Real>
using DrawTiles = WorkCounts (*)(const KernelScene<Real>& scene, const Canvas<Real>& canvas, const Tiles& tiles,
                                 void* memory);

template <class Real>
struct Variant {
    const char* instruction_set;
    int pack;      // pixels rendered at once
    bool counted;  // the variant counts work and can store planes
    DrawTiles<Real> draw;
    std::size_t memory;  // bytes per thread, aligned to 64
};

// The variants in packs that this machine can run, for one fractal, precision and mode; the best is last.
template <class Real>
struct VariantList {
    static constexpr int most = 8;
    Variant<Real> of[most];
    int count;
};

// Measures the multiply-add peak for one instruction set (peak_packs.cpp.in). `run` executes `rounds` iterations of
// multiply_add_chains on one thread and returns their result, because the compiler would otherwise remove the
// iterations.
struct PeakKernel {
    int lanes;
    double (*run)(int rounds);
};

PeakKernel peak_kernel_float(std::int64_t targets);
PeakKernel peak_kernel_double(std::int64_t targets);

}  // namespace mandelmarch::openmp
