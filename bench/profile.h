// Where a picture's time goes: every stage of the kernel text run over a whole picture by itself and timed.
#pragma once

#include "bench/options.h"
#include "bench/result.h"
#include "bench/session.h"

namespace mandelmarch::bench {

// The name of the stage that is the whole pixel without a stop.
inline constexpr const char* in_one_go = "one go";

// Seconds of each stage (begin, march, refine, normal, shade and output), in packs on one core, several times over. The
// rays are stored between the stages, which the whole pixel in one go does not do: stages show shares, not
// speed; the last entry, in_one_go, is the whole for comparison.
std::vector<StageTime> profile(const Options& options, const Phase& phase);

}  // namespace mandelmarch::bench
