// SPDX-License-Identifier: Apache-2.0
// How many lanes of a vector, or of a GPU's warp, do something while rays march.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mandelmarch::bench {

// Shares of lanes that do something, 0 to 1: of the steps, and of the estimator's iterations, each of which takes as
// many as its slowest lane.
struct ActiveLanes {
    double in_steps = 1, in_iterations = 1;
};

struct LaneUse {
    int lanes = 0;
    ActiveLanes together;  // neighbouring pixels go on until the last is done
    // A lane whose ray has ended takes the next pixel of its block at once: persistent threads (Aila and Laine,
    // "Understanding the efficiency of ray traversal on GPUs", HPG 2009).
    // Not known of results of older builds.
    std::optional<ActiveLanes> refilled;
    // Standard errors of `together` and `refilled` if they come from a sample of blocks; 0 if every pixel was counted.
    // Unknown in results of older builds.
    std::optional<ActiveLanes> together_error{}, refilled_error{};
};

// For each of a ray's steps, in order, the iterations of its estimate.
using RaySteps = std::vector<int>;

// Slots that vectors had, and those in which a lane did something.
class LaneCount {
public:
    explicit LaneCount(int lanes) : lanes_(lanes) {}

    // The rays of a block of neighbouring pixels; consecutive ones lie side by side.
    void add(std::span<const RaySteps> block);

    // The lane use of several blocks of a picture, each counted in one LaneCount, all with the same number of lanes.
    // `every_pixel`: they cover the whole picture.
    static LaneUse use(std::span<const LaneCount> blocks, bool every_pixel);

private:
    struct Slots {
        double steps = 0, steps_done = 0, iterations = 0, iterations_done = 0;
    };

    // The share of active lanes over the slots of all blocks, and its standard error.
    static std::pair<ActiveLanes, ActiveLanes> active(std::span<const LaneCount> blocks, Slots LaneCount::*slots);
    // Rays march in a vector; a lane whose ray has ended takes the next of those that wait.
    void march(std::span<const RaySteps> rays, Slots& slots) const;

    int lanes_;
    Slots together_, refilled_;
};

}  // namespace mandelmarch::bench
