// SPDX-License-Identifier: Apache-2.0
// What NVIDIA's driver tells of a GPU and neither OpenACC nor OpenMP has a word for. Its library is opened when first
// asked for; where there is none, or an old one, the answers are those of a host that knows no better.
#pragma once

#include <cstdint>
#include <functional>

#include "core/render/schedule.h"

namespace mandelmarch::job {

// Runs `launch` to its end on the calling thread's GPU, whose kernels go to the default stream. Seconds by the GPU's
// clock, from events round it; by the host's where the driver has no events.
double seconds_on_gpu(const std::function<void()>& launch);

// Pixels that GPU `index` draws in one go: pixels_of_gpu() of the threads that it holds (core/render/schedule.h), and
// the fewest where a watchdog ends kernels after some seconds.
std::int64_t pixels_per_launch(int index);

// False where that is the fewest, which says nothing of the GPU's threads.
inline bool knows_threads(std::int64_t pixels_per_launch) { return pixels_per_launch > fewest_of_gpu; }

}  // namespace mandelmarch::job
