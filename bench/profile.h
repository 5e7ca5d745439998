// SPDX-License-Identifier: Apache-2.0
// Time per stage of a picture: openmp's scheduler, with a clock between its stages.
#pragma once

#include "bench/options.h"
#include "bench/result.h"
#include "bench/session.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

// Name of the entry for whole pixels without interruption.
inline constexpr const char* in_one_go = "one go";

// Measures seconds of each stage (begin, march, refine, normal, shade and output), on one core, in several repetitions.
// Hits are shaded in three passes, and the clock is read every few thousand rays; the last entry, in_one_go, is the
// time without either, for comparison. Throws Error if the picture differs in any byte from that of the registry's
// openmp.
std::vector<StageTime> profile(const Registry& registry, const Options& options, const Phase& phase);

}  // namespace mandelmarch::bench
