// SPDX-License-Identifier: Apache-2.0
// Counts the operations of a picture. The kernel source is compiled with a number type that counts
// (core/kernel/prelude/counting.h) and draws pixels with it, separately from anything that is timed.
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

// Stages of a pixel, in the kernel's order; `shade` excludes the normal.
enum class Stage { begin, march, refine, normal, shade };
inline constexpr int stage_count = 5;
std::string_view name_of(Stage stage);  // "begin" ...

// Standard errors of figures that come from a sample of the picture; 0 if every pixel was counted.
struct CountErrors {
    double per_iteration = 0;  // of Count::per_iteration()
    double per_estimate = 0;   // of the march's iterations per DE evaluation
};

struct Count {
    std::array<Operations, stage_count> stages;
    Work work;                 // of the counted pixels, by the kernel's own counters
    std::uint64_t pixels = 0;  // counted
    std::uint64_t hits = 0;    // among the counted pixels
    // Lane utilisation of the march, for vectors and warps of neighbouring pixels in nearly square rectangles.
    std::vector<LaneUse> lane_use;
    std::uint64_t march_estimates = 0, march_iterations = 0;  // of the march only
    std::optional<CountErrors> errors;                        // unknown in results of older builds

    Operations all() const;
    double per_iteration() const;  // all operations per DE iteration; 0 without iterations
};

struct CountOptions {
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    Techniques techniques = {};
    std::vector<int> lanes = {16, 32};  // sizes of vectors and warps to report lane utilisation for
    // Larger pictures are sampled to about this size: single pixels for operations, patches for lanes.
    std::int64_t most_pixels = 40'000;
};

// Throws Unavailable if the fractal has no kernel.
Count count_operations(const Scene& scene, const CountOptions& options);

// Counts only the given patches. Patches that are neighbours in the list must lie close together in the picture.
// `every_pixel`: they cover the whole picture.
Count count_operations(const Scene& scene, const CountOptions& options, std::span<const Block> blocks,
                       bool every_pixel);

}  // namespace mandelmarch::bench
