// SPDX-License-Identifier: Apache-2.0
// Multiply-add peaks. Each is measured several times, to check whether the highest rate is credible.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/measure/runner.h"

namespace mandelmarch::bench {

// Returns the doubtful ones of the highest rates of each backend, device and precision. Disturbances only lower a rate,
// and rarely twice by the same amount. A highest rate is therefore doubtful if no second measurement is within 5 % of
// it.
std::vector<Peak> doubtful(const std::vector<Peak>& measured);

// Returns a warning for each doubtful peak.
std::vector<std::string> peak_warnings(const std::vector<Peak>& measured);

// Measures the multiply-add peak of every device in the selected precisions. Backends without a peak kernel are left
// out. Before each measurement, calls wanted() with the peak, whose rate is still 0; if wanted() returns false, the
// peak is not measured.
inline bool every_peak(const Peak&) { return true; }
std::vector<Peak> measure_peaks(const Registry& registry, const Options& options, const Phase& phase,
                                const std::function<bool(const Peak&)>& wanted = every_peak);

// Measures doubtful peaks again by calling `again`, at most three times. Returns all measurements.
using PeakMeasurement = std::function<std::vector<Peak>(const std::function<bool(const Peak&)>& wanted)>;
std::vector<Peak> settled_peaks(std::vector<Peak> measured, const PeakMeasurement& again);

}  // namespace mandelmarch::bench
