// SPDX-License-Identifier: Apache-2.0
// Measures the time of each stage of a picture, by reading a clock between the stages of openmp's scheduler.
#pragma once

#include "bench/harness/runner.h"

namespace mandelmarch::bench {

// Measures the seconds of each stage (begin, march, refine, normal, shade and output), on one core, in several
// repetitions. To separate the stages, hits are shaded in three passes, and the clock is read every few thousand rays.
// The last entry, in_one_go, is the time of a picture rendered without these two changes, for comparison. Throws Error
// if the profiled picture differs in any byte from that of the registry's openmp.
std::vector<StageTime> profile(const Registry& registry, const Options& options, const Phase& phase);

}  // namespace mandelmarch::bench
