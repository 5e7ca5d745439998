// SPDX-License-Identifier: Apache-2.0
// Lane utilisation of vectors and of GPU warps during the march.
#pragma once

#include <optional>
#include <span>

#include "core/instruments/operations.h"

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

}  // namespace mandelmarch::bench
