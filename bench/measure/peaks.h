// SPDX-License-Identifier: Apache-2.0
// Multiply-add peaks. Each is measured several times, to check whether the highest rate is credible.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/measure/runner.h"

namespace mandelmarch::bench {

// Record of all measured peaks. Disturbances only lower a rate, and rarely twice by the same amount. A highest rate is
// therefore doubtful if no second measurement is close to it.
class PeakRecord {
public:
    void add(const std::vector<Peak>& peaks);

    // Returns the highest rate of each backend, device and precision.
    std::vector<Peak> best() const;

    // Returns the doubtful peaks: the highest rate of each backend, device and precision if it was measured only once,
    // or if the second highest rate is more than 5 % below it.
    std::vector<Peak> doubtful() const;

    // Returns a warning for each doubtful peak.
    std::vector<std::string> warnings() const;

private:
    // One list for each backend, device and precision, the highest rate first.
    std::vector<std::vector<Peak>> measured_;
};

// Measures the multiply-add peak of every device in the selected precisions. Backends without a peak kernel are left
// out. Before each measurement, calls wanted() with the peak, whose rate is still 0; if wanted() returns false, the
// peak is not measured.
inline bool every_peak(const Peak&) { return true; }
std::vector<Peak> measure_peaks(const Registry& registry, const Options& options, const Phase& phase,
                                const std::function<bool(const Peak&)>& wanted = every_peak);

// Measures doubtful peaks again by calling `again`, at most three times. Returns the record with the added
// measurements.
using PeakMeasurement = std::function<std::vector<Peak>(const std::function<bool(const Peak&)>& wanted)>;
PeakRecord settled_peaks(PeakRecord record, const PeakMeasurement& again);

}  // namespace mandelmarch::bench
