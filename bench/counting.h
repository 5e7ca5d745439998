// SPDX-License-Identifier: Apache-2.0
// The operations that a picture takes. They are counted by compiling the kernel text with a counting number type
// (core/kernel/prelude/counting.h) and drawing pixels with it, apart from anything that is timed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bench/lanes.h"
#include "bench/sample.h"
#include "core/render/backend.h"

namespace mandelmarch::bench {

struct Operations {
    std::uint64_t sums = 0, products = 0, quotients = 0, roots = 0;

    std::uint64_t total() const { return sums + products + quotients + roots; }
};

Operations operator+(Operations a, Operations b);
Operations operator-(Operations a, Operations b);

// The stages of a pixel, in the text's order; `shade` is what is left of it without the normal.
enum class Stage { begin, march, refine, normal, shade };
inline constexpr int stage_count = 5;
std::string_view name_of(Stage stage);  // "begin" ...

// Standard errors of the figures that come from a sample of the picture; 0 if every pixel was counted.
struct CountErrors {
    double per_iteration = 0;  // of Count::per_iteration()
    double per_estimate = 0;   // of the march's iterations for each of its estimates
};

struct Count {
    std::array<Operations, stage_count> stages;
    Work work;                 // of the pixels that were counted, by the text's own counters
    std::uint64_t pixels = 0;  // that were counted
    std::uint64_t hits = 0;    // of them
    // The lane use of the march, for vectors and warps of neighbouring pixels in nearly square rectangles.
    std::vector<LaneUse> lane_use;
    std::uint64_t march_estimates = 0, march_iterations = 0;  // of the march alone
    std::optional<CountErrors> errors;                        // unknown in results of older builds

    Operations all() const;
    double per_iteration() const;  // operations of everything, for each iteration of the estimator; 0 if there is none
};

struct CountOptions {
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    Techniques techniques = {};
    std::vector<int> lanes = {16, 32};  // of the vectors and warps whose use is asked
    // Larger pictures are sampled to about this size: single pixels for operations, blocks of pixels for lanes.
    std::int64_t most_pixels = 40'000;
};

// Throws Unavailable if the fractal has no text.
Count count_operations(const Scene& scene, const CountOptions& options);

// Counts only the given blocks. Blocks that are neighbours in the list must lie close together in the picture.
// `every_pixel`: they cover the whole picture.
Count count_operations(const Scene& scene, const CountOptions& options, std::span<const Block> blocks,
                       bool every_pixel);

}  // namespace mandelmarch::bench
