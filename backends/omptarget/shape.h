// SPDX-License-Identifier: Apache-2.0
// Division of a loop among a device's threads.
#pragma once

#include <omp.h>

#include "core/job/job.h"

namespace mandelmarch::omptarget {

struct Shape {
    int teams;
    int threads;  // per team
};

inline constexpr int warp_threads = 32;

// On a GPU, a team is a block, its threads are warps, and the threads of a warp are the lanes of `simd`; without `simd`
// only one thread per warp would work. The host is one team of all cores.
inline Shape shape_of(int iterations)
{
    if (omp_get_default_device() == omp_get_initial_device()) return {1, omp_get_max_threads()};
    return {iterations / job::block_threads, job::block_threads / warp_threads};
}

// Clauses for a loop, from a variable `shape`. A thread takes the pixels of one warp at a time.
#define MM_SHAPE num_teams(shape.teams) thread_limit(shape.threads) num_threads(shape.threads) schedule(dynamic, 32)

}  // namespace mandelmarch::omptarget
