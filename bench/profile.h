// SPDX-License-Identifier: Apache-2.0
// Where a picture's time goes: openmp's scheduler with a clock between its stages.
#pragma once

#include "bench/options.h"
#include "bench/result.h"
#include "bench/session.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

// The name of the stage that is the whole pixel without a stop.
inline constexpr const char* in_one_go = "one go";

// Seconds of each stage (begin, march, refine, normal, shade and output), on one core, several times over. Hits are
// shaded in three passes here, and the clock is read every few thousand rays; the last entry, in_one_go, is the whole
// without either, for comparison. Throws Error where the picture is not, byte for byte, the one that the registry's
// openmp draws.
std::vector<StageTime> profile(const Registry& registry, const Options& options, const Phase& phase);

}  // namespace mandelmarch::bench
