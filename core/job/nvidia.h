// SPDX-License-Identifier: Apache-2.0
// Queries of NVIDIA's driver that OpenACC and OpenMP lack. The library is loaded on first use; without it, or with an
// old one, callers get conservative defaults.
#pragma once

#include <cstdint>
#include <functional>

#include "core/render/schedule.h"

namespace mandelmarch::job {

// Runs `launch`, whose kernels go to the default stream, to completion on the calling thread's GPU. Returns seconds by
// the GPU's clock, from events around it; by the host's clock if the driver has no events.
double seconds_on_gpu(const std::function<void()>& launch);

// Returns the pixels per launch of GPU `index`: pixels_of_gpu() of its resident threads (core/render/schedule.h), or
// fewest_of_gpu if a watchdog ends kernels after some seconds.
std::int64_t pixels_per_launch(int index);

// False for fewest_of_gpu, which does not depend on the GPU's threads.
inline bool knows_threads(std::int64_t pixels_per_launch) { return pixels_per_launch > fewest_of_gpu; }

}  // namespace mandelmarch::job
