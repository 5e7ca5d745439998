// SPDX-License-Identifier: Apache-2.0
// Counts the arithmetic operations of a picture (core/instruments/operations.h).
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "bench/counting/lanes.h"
#include "bench/counting/sample.h"
#include "core/render/backend.h"
#include "core/instruments/operations.h"

namespace mandelmarch::bench {

// Standard errors of two ratios that are computed from a sample of the pixels; 0 if every pixel was counted.
struct CountErrors {
    double per_iteration = 0;  // of Count::per_iteration()
    double per_estimate = 0;   // of Count::march_iterations / Count::march_estimates
};

struct Count {
    std::array<Operations, stage_count> stages;
    Work work;                 // work of the counted pixels, from the kernel's own counters
    std::uint64_t pixels = 0;  // number of counted pixels
    std::uint64_t hits = 0;    // number of counted pixels that hit
    // Lane utilisation of the march, for each length of CountOptions::lanes. The pixels of a vector or warp are
    // neighbours and form a square, or a rectangle with twice as many columns as rows.
    std::vector<LaneUse> lane_use;
    std::uint64_t march_estimates = 0, march_iterations = 0;  // DE evaluations and DE iterations of the march alone
    std::optional<CountErrors> errors;                        // nullopt: unknown

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
    // If a picture has more pixels than this, only about this many are counted: single pixels for operations, patches
    // of neighbouring pixels for lane utilisation.
    std::int64_t most_pixels = 40'000;
};

// Counts the operations of a picture, or of a sample of its pixels. Throws Unavailable if there is no counting kernel
// for the fractal.
Count count_operations(const Scene& scene, const CountOptions& options);

// Counts only the given patches. Patches that are neighbours in the list must lie close together in the picture.
// `every_pixel`: true if the patches cover the whole picture; standard errors are then 0.
Count count_operations(const Scene& scene, const CountOptions& options, std::span<const Block> blocks,
                       bool every_pixel);

}  // namespace mandelmarch::bench
