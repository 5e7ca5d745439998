// SPDX-License-Identifier: Apache-2.0
// Counts the arithmetic operations of a picture (core/instruments/operations.h), and the lanes of vectors and of GPU
// warps that are active during the march.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "core/instruments/operations.h"
#include "core/render/backend.h"

namespace mandelmarch::bench {

// Fractions of lanes that are active, 0 to 1: the average over all steps that vectors take, and the average over all
// their DE iterations. A step of a vector takes as many iterations as its slowest lane; a lane that needs fewer is
// inactive in the remaining ones.
struct ActiveLanes {
    double in_steps = 1, in_iterations = 1;
};

struct LaneUse {
    int lanes = 0;
    ActiveLanes together;  // without refill: the pixels of a vector march together until the last of them is done
    // With refill: as soon as a lane's ray has ended, the lane takes the next pixel of the patch (persistent threads;
    // Aila and Laine, "Understanding the efficiency of ray traversal on GPUs", HPG 2009). nullopt: unknown.
    std::optional<ActiveLanes> refilled;
};

// Counts the lane slots of vectors, and how many of them are active. A lane slot is one lane during one step, or one
// iteration, of its vector.
class LaneCount {
public:
    explicit LaneCount(int lanes) : lanes_(lanes) {}

    // Adds the rays of a patch; consecutive rays belong to neighbouring pixels.
    void add(std::span<const RaySteps> block);
    // Adds the slots of other patches, for vectors of the same length.
    void add(const LaneCount& other);

    LaneUse use() const;

private:
    struct Slots {
        double steps = 0, steps_done = 0, iterations = 0, iterations_done = 0;

        void add(const Slots& other);
        ActiveLanes active() const;
    };

    // Marches the rays in one vector and adds its lane slots to `slots`. A lane whose ray has ended takes the next
    // waiting ray.
    void march(std::span<const RaySteps> rays, Slots& slots) const;

    int lanes_;
    Slots together_, refilled_;
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
    std::size_t most_pixels = 600 * 600;
};

// Counts the operations of a picture or, if it has more than options.most_pixels pixels, of evenly spread blocks of it.
// Throws Unavailable if there is no counting kernel for the fractal.
Count count_operations(const Scene& scene, const CountOptions& options);

}  // namespace mandelmarch::bench
