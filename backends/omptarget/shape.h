// SPDX-License-Identifier: Apache-2.0
// How a loop is shared among a device's threads.
#pragma once

#include <omp.h>

#include "core/job/job.h"

namespace mandelmarch::omptarget {

struct Shape {
    int teams;
    int threads;  // of a team
};

inline constexpr int warp_threads = 32;

// On a GPU a team is a block, its threads are warps, and a warp's threads the lanes of `simd`: without that word one of
// them would work. The host is one team of all cores.
inline Shape shape_of(int iterations)
{
    if (omp_get_default_device() == omp_get_initial_device()) return {1, omp_get_max_threads()};
    return {iterations / job::block_threads, job::block_threads / warp_threads};
}

// Clauses of a loop with a variable `shape`. A thread takes a warp's pixels at a time.
#define MM_SHAPE num_teams(shape.teams) thread_limit(shape.threads) num_threads(shape.threads) schedule(dynamic, 32)

}  // namespace mandelmarch::omptarget
