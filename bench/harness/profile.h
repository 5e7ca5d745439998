// SPDX-License-Identifier: Apache-2.0
// Measures the time of each stage of a picture. The backend openmp is profiled: a clock is read between its stages.
#pragma once

#include "bench/harness/runner.h"

namespace mandelmarch::bench {

// Measures the seconds of each stage (begin, march, refine, normal, shade and output), on one core, in several
// repetitions. To separate the stages, hits are shaded in three passes, and the clock is read every few thousand rays.
// The last entry, in_one_go, is for comparison: the time of a picture rendered without these two changes. Throws Error
// if the profiled picture differs in any byte from the picture that the registry's openmp renders.
std::vector<StageTime> profile(const Registry& registry, const Options& options, const Phase& phase);

}  // namespace mandelmarch::bench
