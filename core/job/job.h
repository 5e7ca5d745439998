// SPDX-License-Identifier: Apache-2.0
// A job: the pixels of some rows, as the kernels of models that compile the scalar text take them.
#pragma once

namespace mandelmarch::job {

// What a launch works on: rows [first_row, first_row + rows) of the picture. It lies on the device, as do the planes,
// which are those of planes_of() in core/image/image.h. Scene is the kernel text's.
template <class Scene, class Real>
struct Job {
    Scene scene;
    Real* reals;
    int* wholes;
    unsigned char* bytes;  // three a pixel, where nothing else is asked for; else nullptr
    const Real* camera;    // core/job/camera_table.h
    int first_row;
    int rows;
    int pixels_of_thread;  // that a thread marches one after the other, where lanes refill (pixels.h)
};

// Draws a job of width x rows pixels, which lies at this address of the device.
using Launch = void (*)(const void* job, int width, int rows);

// Runs core/kernel/peak.h on as many threads as there are sums, numbers of the precision on the device.
using Chains = void (*)(void* sums, int threads, double a, double b, int rounds);

// Of GPUs: threads of a block.
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

// Threads that a job takes, in whole blocks.
constexpr int threads_of(int width, int rows) { return blocks_of(width, rows) * block_threads; }

}  // namespace mandelmarch::job
