// SPDX-License-Identifier: Apache-2.0
// Counts the arithmetic operations of a picture (core/instruments/operations.h).
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "bench/counting/lanes.h"
#include "core/render/backend.h"
#include "core/instruments/operations.h"

namespace mandelmarch::bench {

struct Count {
    std::array<Operations, stage_count> stages;
    Work work;                 // work of the counted pixels, from the kernel's own counters
    std::uint64_t pixels = 0;  // number of counted pixels
    std::uint64_t hits = 0;    // number of counted pixels that hit
    // Lane utilisation of the march, for each length of CountOptions::lanes. The pixels of a vector or warp are
    // neighbours and form a square, or a rectangle with twice as many columns as rows.
    std::vector<LaneUse> lane_use;
    std::uint64_t march_estimates = 0, march_iterations = 0;  // DE evaluations and DE iterations of the march alone

    Count& operator+=(const Count& other);  // adds everything but lane_use
    Operations all() const { return std::accumulate(stages.begin(), stages.end(), Operations{}); }
    // Returns all operations / all DE iterations; 0 if there are no iterations.
    double per_iteration() const
    {
        return work.iterations == 0 ? 0 : static_cast<double>(all().total()) / static_cast<double>(work.iterations);
    }
};

struct CountOptions {
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    Techniques techniques = {};
    std::vector<int> lanes = {16, 32};  // lengths of the vectors or warps for which lane utilisation is computed
    std::int64_t most_pixels = 600 * 600;
};

// Counts the operations of a picture or, if it has more than options.most_pixels pixels, of a smaller picture of the
// same view. Throws Unavailable if there is no counting kernel for the fractal.
Count count_operations(const Scene& scene, const CountOptions& options);

}  // namespace mandelmarch::bench
