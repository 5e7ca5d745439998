// SPDX-License-Identifier: Apache-2.0
// The functions that a programming model's kernels have on the host.
#pragma once

#include <span>

#include "core/models/job.h"

namespace mandelmarch::job {

// What a device does for a job: it takes the job if all sizes are 0, or marches its cones and renders its pixels.
struct Task {
    const void* job = nullptr;  // KernelArguments: on the host if Kernels::take_job, otherwise on the device
    int tiles = 0;              // with cones to march
    int cells = 0;              // of the lattice (core/render/lattice.h)
    int threads = 0;            // of a GPU that render at once
};

// Does the tasks of up to most_jobs jobs at the same time; the last job may be larger than the others.
using DrawKernel = void(std::span<const Task> tasks);
inline constexpr int most_jobs = 3;

// Runs the chains of core/kernel/peak.h on `threads` threads. `sums` is device memory for one number per thread.
using Chains = void(void* sums, int threads, double a, double b, int rounds);

}  // namespace mandelmarch::job
