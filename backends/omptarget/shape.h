// SPDX-License-Identifier: Apache-2.0
// Divides a loop among a device's threads.
#pragma once

#include <omp.h>

#include <algorithm>

#include "core/models/task.h"

namespace mandelmarch::omptarget {

struct Shape {
    int teams;
    int threads;  // per team
};

// Returns true if a device of OpenMP is a CPU: the host, or a device that shares its cores.
inline bool on_cpu(int device)
{
#ifdef MM_DEVICE_IS_CPU
    static_cast<void>(device);
    return true;
#else
    return device == omp_get_initial_device();
#endif
}

// The warps of a launch, at most. An enumerator, because clang++ wants constants in target regions to be declared
// there.
enum { most_warps = 1 << 14 };

// On a GPU, g++ maps a team to a GPU thread block, an OpenMP thread to a warp, and the lanes of `simd` to the warp's 32
// threads; without `simd`, only one thread of each warp would work. On a CPU, one team uses all cores.
inline Shape shape_of(int iterations)
{
    if (on_cpu(omp_get_default_device())) return {1, omp_get_max_threads()};
    constexpr int warps = job::block_threads / job::warp_threads;
    return {std::min(iterations / job::block_threads, most_warps / warps), warps};
}

// Clauses that divide a loop according to the local variable `shape`.
#define MM_SHAPE num_teams(shape.teams) thread_limit(shape.threads) num_threads(shape.threads)

}  // namespace mandelmarch::omptarget
