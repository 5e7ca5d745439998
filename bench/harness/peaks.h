// SPDX-License-Identifier: Apache-2.0
// Peaks that are measured several times, and a check whether the highest one is credible.
#pragma once

#include <string>
#include <vector>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Record of all measured peaks. Disturbances only lower a rate, and rarely twice by the same amount. A highest rate is
// therefore doubtful if no second measurement is close to it.
class PeakRecord {
public:
    void add(const std::vector<Peak>& peaks);

    // Returns the highest rate of each backend, device and precision.
    std::vector<Peak> best() const;

    // Returns one peak for each backend, device and precision that was measured only once, or whose two highest rates
    // are more than 5 % apart.
    std::vector<Peak> doubtful() const;

    // Returns a warning for each doubtful peak.
    std::vector<std::string> warnings() const;

private:
    // One list for each backend, device and precision, in the order of measurement.
    std::vector<std::vector<Peak>> measured_;
};

}  // namespace mandelmarch::bench
