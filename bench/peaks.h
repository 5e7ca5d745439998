// SPDX-License-Identifier: Apache-2.0
// Peaks that were measured several times: whether the best of them is to be believed.
#pragma once

#include <string>
#include <vector>

#include "bench/result.h"

namespace mandelmarch::bench {

// A disturbance only lowers a rate, and hardly twice by as much: a best rate that no other comes near stands alone
// among spoilt ones, or is spoilt itself.
class PeakRecord {
public:
    void add(const std::vector<Peak>& peaks);

    // The highest rate of each backend, device and precision.
    std::vector<Peak> best() const;

    // Those whose two highest rates are more than 5 % apart, or that were measured once.
    std::vector<Peak> doubtful() const;

    // A line for each of these.
    std::vector<std::string> warnings() const;

private:
    // Of one backend, device and precision, in the order in which they came.
    std::vector<std::vector<Peak>> measured_;
};

}  // namespace mandelmarch::bench
