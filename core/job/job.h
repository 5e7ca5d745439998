// SPDX-License-Identifier: Apache-2.0
// Arguments of the kernels in models that compile the scalar kernel: the pixels of some rows.
#pragma once

namespace mandelmarch::job {

// Arguments of a launch: rows [first_row, first_row + rows) of the picture. Resides on the device, as do the planes,
// which have the layout of planes_of() in core/image/image.h. Scene is the kernel's type.
template <class Scene, class Real>
struct KernelArguments {
    Scene scene;
    Real* reals;
    int* wholes;
    unsigned char* bytes;  // three per pixel, if only bytes are needed; otherwise nullptr
    const Real* camera;    // core/job/camera_table.h
    int first_row;
    int rows;
    int pixels_of_thread;  // pixels that a thread marches in turn, with refill (pixels.h)
};

// Renders width x rows pixels; `job` is an address on the device.
using DrawKernel = void (*)(const void* job, int width, int rows);

// Runs core/kernel/peak.h on `threads` threads; `sums` has one number per thread, on the device.
using Chains = void (*)(void* sums, int threads, double a, double b, int rounds);

// Threads per GPU block.
inline constexpr int block_threads = 128;
// A warp's 32 threads cover a rectangle of pixels, so that its rays stay close together.
inline constexpr int warp_width = 8;
inline constexpr int warp_height = 4;

// Returns the number of blocks of a job.
constexpr int blocks_of(int width, int rows)
{
    constexpr int warps_per_block = block_threads / (warp_width * warp_height);
    const int warps = ((width + warp_width - 1) / warp_width) * ((rows + warp_height - 1) / warp_height);
    return (warps + warps_per_block - 1) / warps_per_block;
}

// Returns the number of threads of a job, a multiple of the block size.
constexpr int threads_of(int width, int rows) { return blocks_of(width, rows) * block_threads; }

}  // namespace mandelmarch::job
