// SPDX-License-Identifier: Apache-2.0
// Runs a whole study: plan, verification, counting, peaks, timed rounds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/study/options.h"
#include "bench/harness/peaks.h"
#include "bench/result/result.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

// The current phase, its completed fraction, 0 to 1, and the position within it, "round 3 of 40".
struct Step {
    std::string what;
    double share = 0;
    std::string detail{};
};
using Phase = std::function<void(const Step&)>;

// Runs the study that the options name. All pictures are verified before anything is timed; a configuration with a
// wrong picture is not timed. Throws InputError if the options are invalid, Unavailable if the only selected backend is
// not available.
Result measure(const Registry& registry, const Options& options, const Phase& phase);

// Measures the multiply-add peak of every device in the selected precisions. Backends without a peak kernel are left
// out. `wanted` is called with each peak before it is measured (rate 0); if it returns false, the peak is not measured.
inline bool every_peak(const Peak&) { return true; }
std::vector<Peak> measure_peaks(const Registry& registry, const Options& options, const Phase& phase,
                                const std::function<bool(const Peak&)>& wanted = every_peak);

// Measures doubtful peaks again, at most three times. Returns the record with the added measurements.
using PeakMeasurement = std::function<std::vector<Peak>(const std::function<bool(const Peak&)>& wanted)>;
PeakRecord settled_peaks(PeakRecord record, const PeakMeasurement& again);

}  // namespace mandelmarch::bench
