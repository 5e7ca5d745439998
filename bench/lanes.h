// SPDX-License-Identifier: Apache-2.0
// Lane utilisation of vectors and of GPU warps during the march.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mandelmarch::bench {

// Fractions of active lanes, 0 to 1, among the steps and among the DE iterations. A step takes as many iterations as
// its slowest lane.
struct ActiveLanes {
    double in_steps = 1, in_iterations = 1;
};

struct LaneUse {
    int lanes = 0;
    ActiveLanes together;  // neighbouring pixels march until the last one is done
    // With refill: a lane whose ray has ended takes the next pixel of its patch at once (persistent threads; Aila and
    // Laine, "Understanding the efficiency of ray traversal on GPUs", HPG 2009). Unknown in results of older builds.
    std::optional<ActiveLanes> refilled;
    // Standard errors of `together` and `refilled` if they come from a sample of patches; 0 if every pixel was counted.
    // Unknown in results of older builds.
    std::optional<ActiveLanes> together_error{}, refilled_error{};
};

// DE iterations of each step of a ray, in order.
using RaySteps = std::vector<int>;

// Counts the lane slots of vectors, and the active ones among them.
class LaneCount {
public:
    explicit LaneCount(int lanes) : lanes_(lanes) {}

    // Adds the rays of a patch; consecutive rays belong to neighbouring pixels.
    void add(std::span<const RaySteps> block);

    // Returns the lane utilisation of several patches, each counted in one LaneCount, all with the same number of
    // lanes. `every_pixel`: they cover the whole picture.
    static LaneUse use(std::span<const LaneCount> blocks, bool every_pixel);

private:
    struct Slots {
        double steps = 0, steps_done = 0, iterations = 0, iterations_done = 0;
    };

    // Returns the fraction of active lanes over all patches, and its standard error.
    static std::pair<ActiveLanes, ActiveLanes> active(std::span<const LaneCount> blocks, Slots LaneCount::*slots);
    // Marches rays in a vector; a lane whose ray has ended takes the next waiting ray.
    void march(std::span<const RaySteps> rays, Slots& slots) const;

    int lanes_;
    Slots together_, refilled_;
};

}  // namespace mandelmarch::bench
