// SPDX-License-Identifier: Apache-2.0
// Arguments of kernels that a programming model compiles from the scalar kernel. A launch renders the pixels of some
// rows.
#pragma once

#include "core/render/lattice.h"

namespace mandelmarch::job {

// Arguments of a launch, called a job. A job renders the pixels of a lattice in rows [first_row, first_row + rows) of
// the picture, or marches the cones of these rows. Its buffers are in device memory, and the job, too, unless the
// kernels take it by value; the planes have the layout of planes_of() in core/image/image.h. Scene is the kernel's
// type.
template <class Scene, class Real>
struct KernelArguments {
    int* taken;  // number of pixels that threads have taken from the queue; the first member (take_job)
    alignas(64) Scene scene;
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
    int chunk;  // pixels that a warp takes at once, with threads.h
};

// Threads per GPU thread block.
inline constexpr int block_threads = 128;
// Warps of a GPU's multiprocessor that render at once, by default. With fewer, latencies are not hidden; with more, the
// last rays of a picture share their multiprocessors with others, and take longer. NVIDIA's GPUs of a compute
// capability below 7.0 have longer latencies, and render with as many warps as they can hold.
inline constexpr int resident_warps = 16;
inline constexpr int resident_warps_before_70 = 64;
inline constexpr int warp_threads = 32;
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
