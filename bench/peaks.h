// SPDX-License-Identifier: Apache-2.0
// Peaks measured several times, and whether the best of them is credible.
#pragma once

#include <string>
#include <vector>

#include "bench/result.h"

namespace mandelmarch::bench {

// Measured peaks. A disturbance only lowers a rate, and rarely twice by the same amount: a best rate without a second
// one close to it is doubtful.
class PeakRecord {
public:
    void add(const std::vector<Peak>& peaks);

    // Returns the highest rate of each backend, device and precision.
    std::vector<Peak> best() const;

    // Returns the peaks whose two highest rates are more than 5 % apart, or that were measured once.
    std::vector<Peak> doubtful() const;

    // Returns a warning for each doubtful peak.
    std::vector<std::string> warnings() const;

private:
    // One list for each backend, device and precision, in the order of measurement.
    std::vector<std::vector<Peak>> measured_;
};

}  // namespace mandelmarch::bench
