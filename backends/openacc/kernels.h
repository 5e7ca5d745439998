// SPDX-License-Identifier: Apache-2.0
// The kernels: the text compiled for one fractal, precision and mode. A source is generated for each of these.
#pragma once

#include <string_view>

#include "core/render/backend.h"

namespace mandelmarch::openacc {

// What a launch works on: rows [first_row, first_row + rows) of the picture. It lies on the device, as do the planes,
// which are those of planes_of() in core/image/image.h. Scene is the kernel text's.
template <class Scene, class Real>
struct Job {
    Scene scene;
    Real* reals;
    int* wholes;
    int first_row;
    int rows;
};

inline constexpr int block_threads = 128;
// The 32 threads of a warp cover a rectangle of pixels, so that its rays stay close to each other.
inline constexpr int warp_width = 8;
inline constexpr int warp_height = 4;

// Blocks that a job takes.
constexpr int blocks_of(int width, int rows)
{
    constexpr int warps_per_block = block_threads / (warp_width * warp_height);
    const int warps = ((width + warp_width - 1) / warp_width) * ((rows + warp_height - 1) / warp_height);
    return (warps + warps_per_block - 1) / warps_per_block;
}

// Runs a kernel on the job at this address of the device.
using Launch = void (*)(const void* job, int blocks);

// A pixel is drawn by two kernels, as the few registers of the march let a GPU keep more threads than shading does. In
// between a ray waits in its own pixel's planes.
struct Kernels {
    Launch march;
    Launch shade;
};

// Throws Unavailable if this build does not draw the fractal.
template <class Real>
Kernels kernels_of(std::string_view fractal, Mode mode);

}  // namespace mandelmarch::openacc
