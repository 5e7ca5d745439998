// SPDX-License-Identifier: Apache-2.0
// Arguments of kernels that a programming model compiles from the scalar kernel. A launch renders the pixels of some
// rows.
#pragma once

namespace mandelmarch::job {

// Arguments of a launch, called a job. A job renders rows [first_row, first_row + rows) of the picture. The job and its
// planes are in device memory; the planes have the layout of planes_of() in core/image/image.h. Scene is the kernel's
// type.
template <class Scene, class Real>
struct KernelArguments {
    Scene scene;
    Real* reals;
    int* wholes;
    unsigned char* bytes;  // three per pixel; nullptr: the planes are needed, not the bytes
    const Real* camera;    // table of core/job/camera_table.h
    int first_row;
    int rows;
    int pixels_of_thread;  // pixels that a thread marches one after the other, with refill (pixels.h)
};

// Renders the width x rows pixels of a job. `job` is the address of its KernelArguments on the device.
using DrawKernel = void(const void* job, int width, int rows);

// Runs the chains of core/kernel/peak.h on `threads` threads. `sums` is device memory for one number per thread.
using Chains = void(void* sums, int threads, double a, double b, int rounds);

// Threads per GPU thread block.
inline constexpr int block_threads = 128;
// The 32 threads of a warp render a rectangle of pixels of this size, so that their rays stay close together.
inline constexpr int warp_width = 8;
inline constexpr int warp_height = 4;

// Returns the number of GPU thread blocks of a job.
constexpr int blocks_of(int width, int rows)
{
    constexpr int warps_per_block = block_threads / (warp_width * warp_height);
    const int warps = ((width + warp_width - 1) / warp_width) * ((rows + warp_height - 1) / warp_height);
    return (warps + warps_per_block - 1) / warps_per_block;
}

// Returns the number of threads of a job, a multiple of block_threads.
constexpr int threads_of(int width, int rows) { return blocks_of(width, rows) * block_threads; }

}  // namespace mandelmarch::job
