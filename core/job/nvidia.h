// SPDX-License-Identifier: Apache-2.0
// Uses NVIDIA's driver for queries that OpenACC and OpenMP do not support. The driver's library is loaded on first use.
// If it is missing or too old, the host's clock measures times, and launches have the fewest pixels that suit a GPU.
#pragma once

#include <cstdint>
#include <functional>

#include "core/render/schedule.h"

namespace mandelmarch::job {

// Runs `launch`, which launches kernels in the default stream of the calling thread's GPU, then `wait`, which waits for
// them and throws Error if one has failed; empty: the launch waits itself. Returns the kernels' seconds, measured by
// events on the GPU; if the driver has no events, by the host's clock.
double seconds_on_gpu(const std::function<void()>& launch, const std::function<void()>& wait = {});

// Returns the number of pixels per launch for a GPU: pixels_of_gpu(threads) of core/render/schedule.h, where `threads`
// is the GPU's number of resident threads. Returns fewest_of_gpu if this number is unknown or if a watchdog ends
// kernels that take several seconds.
std::int64_t pixels_per_launch(int index);

// Returns true if a result of pixels_per_launch() was derived from the GPU's number of threads.
inline bool knows_threads(std::int64_t pixels_per_launch) { return pixels_per_launch > fewest_of_gpu; }

}  // namespace mandelmarch::job
