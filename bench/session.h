// SPDX-License-Identifier: Apache-2.0
// A whole study: plan, proof, counting, peaks, timed rounds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/options.h"
#include "bench/peaks.h"
#include "bench/result.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

// The present phase, the finished share of it, 0 to 1, and the position within it, "round 3 of 40".
struct Step {
    std::string what;
    double share = 0;
    std::string detail{};
};
using Phase = std::function<void(const Step&)>;

// Measures the study that the options name. Every row's picture is drawn and compared before anything is timed; a row
// whose picture fails is not timed. Throws InputError where the options are wrong, Unavailable where the one backend
// that was asked for is not there.
Result measure(const Registry& registry, const Options& options, const Phase& phase);

// The multiply-add peak of every device in the precisions asked for, of those that are wanted (by all but their rate).
// Backends that measure none are left out.
inline bool every_peak(const Peak&) { return true; }
std::vector<Peak> measure_peaks(const Registry& registry, const Options& options, const Phase& phase,
                                const std::function<bool(const Peak&)>& wanted = every_peak);

// The record, with those peaks measured again, three times at most, that are doubtful.
using PeakMeasurement = std::function<std::vector<Peak>(const std::function<bool(const Peak&)>& wanted)>;
PeakRecord settled_peaks(PeakRecord record, const PeakMeasurement& again);

}  // namespace mandelmarch::bench
