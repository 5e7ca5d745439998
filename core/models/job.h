// SPDX-License-Identifier: Apache-2.0
// Arguments of kernels that a programming model compiles from the scalar kernel. A launch renders the pixels of some
// rows.
#pragma once

#include "core/render/lattice.h"

namespace mandelmarch::job {

// Arguments of a launch, called a job. A job renders the pixels of a lattice in rows [first_row, first_row + rows) of
// the picture, or marches the cones of these rows. The job and its buffers are in device memory; the planes have the
// layout of planes_of() in core/image/image.h. Scene is the kernel's type.
template <class Scene, class Real>
struct KernelArguments {
    // Number of pixels that threads have taken, with refill. No other member is changed by kernels. It must be the
    // first one: cmake/nvptx_as.in uses the job's address for it.
    mutable int taken;
    alignas(64) Scene scene;  // in another cache line than `taken`, whose changes would delay reading it
    Real* reals;
    int* wholes;
    unsigned char* bytes;  // three per pixel; nullptr: the planes are needed, not the bytes
    const Real* camera;    // table of core/models/camera_table.h
    Real* starts;          // for each tile with a cone, the t at which its rays begin
    int* cone_work;        // for each such tile, the DE evaluations and the iterations of its cone
    Real* depths;          // depths that pixels in even columns and rows pass on, at half the pixel's index
    int cone_side;         // side of the tiles with cones, in pixels; 0: there are no cones
    Lattice lattice;       // on GPUs always {0, 1}
    int first_row;
    int rows;
    int threads;  // number of threads that march, with refill (threads.h)
};

// The size of a job.
struct Launch {
    int tiles = 0;  // cones to march; 0: the job renders pixels
    int cells = 0;  // cells of the lattice (core/render/lattice.h)
    int width = 0;  // pixels
    int rows = 0;
};

// Marches the cones of a job or renders its pixels. `job` is the address of its KernelArguments on the device.
using DrawKernel = void(const void* job, const Launch& launch);

// Runs the chains of core/kernel/peak.h on `threads` threads. `sums` is device memory for one number per thread.
using Chains = void(void* sums, int threads, double a, double b, int rounds);

// Threads per GPU thread block.
inline constexpr int block_threads = 128;
// The 32 threads of a warp render a rectangle of pixels of this size, so that their rays stay close together.
inline constexpr int warp_width = 8;
inline constexpr int warp_height = 4;

// Returns the number of GPU thread blocks that march `tiles` cones.
constexpr int blocks_of_cones(int tiles) { return (tiles + block_threads - 1) / block_threads; }

// Returns the number of GPU thread blocks that render width x rows pixels.
constexpr int blocks_of(int width, int rows)
{
    constexpr int warps_per_block = block_threads / (warp_width * warp_height);
    const int warps = ((width + warp_width - 1) / warp_width) * ((rows + warp_height - 1) / warp_height);
    return (warps + warps_per_block - 1) / warps_per_block;
}

}  // namespace mandelmarch::job
