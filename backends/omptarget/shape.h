// SPDX-License-Identifier: Apache-2.0
// Divides a loop among a device's threads.
#pragma once

#include <omp.h>

#include "core/models/job.h"

namespace mandelmarch::omptarget {

struct Shape {
    int teams;
    int threads;  // per team
    int chunk;    // iterations that a team takes at a time
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

inline constexpr int warp_threads = 32;
// A team on a GPU takes this many blocks of iterations at a time, and its warps then wait for each other. With fewer
// blocks they would wait longer; with more, a team could get all expensive pixels (docs/notes/experiments.md).
inline constexpr int blocks_at_a_time = 2;

// On a GPU, g++ maps a team to a GPU thread block, an OpenMP thread to a warp, and the lanes of `simd` to the warp's 32
// threads; without `simd`, only one thread of each warp would work. The run-time library starts fewer teams than
// blocks: as many as the GPU holds at once. They take blocks in turns. On a CPU, one team uses all cores.
inline Shape shape_of(int iterations)
{
    if (on_cpu(omp_get_default_device())) return {1, omp_get_max_threads(), iterations};
    return {iterations / job::block_threads, job::block_threads / warp_threads, blocks_at_a_time * job::block_threads};
}

// Clauses that divide a loop according to the local variable `shape`. An OpenMP thread takes 32 iterations at a time,
// one for each thread of its warp.
#define MM_SHAPE                                                                                        \
    num_teams(shape.teams) thread_limit(shape.threads) num_threads(shape.threads) schedule(dynamic, 32) \
        dist_schedule(static, shape.chunk)

}  // namespace mandelmarch::omptarget
