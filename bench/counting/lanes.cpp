// SPDX-License-Identifier: Apache-2.0
#include "bench/counting/lanes.h"

#include <algorithm>
#include <cstddef>

namespace mandelmarch::bench {

void LaneCount::march(std::span<const RaySteps> rays, Slots& slots) const
{
    struct Lane {
        const RaySteps* ray = nullptr;
        std::size_t step = 0;
    };
    const auto lanes = std::min(static_cast<std::size_t>(lanes_), rays.size());
    std::vector<Lane> vector(lanes);
    std::size_t next = 0;
    for (;;) {
        double active = 0;
        int slowest = 0;
        double done = 0;
        for (Lane& lane : vector) {
            while ((lane.ray == nullptr || lane.step == lane.ray->size()) && next < rays.size()) lane = {&rays[next++]};
            if (lane.ray == nullptr || lane.step == lane.ray->size()) continue;
            const int iterations = (*lane.ray)[lane.step++];
            slowest = std::max(slowest, iterations);
            done += iterations;
            ++active;
        }
        if (active == 0) return;
        slots.steps += static_cast<double>(lanes);
        slots.steps_done += active;
        slots.iterations += static_cast<double>(lanes) * slowest;
        slots.iterations_done += done;
    }
}

void LaneCount::add(std::span<const RaySteps> block)
{
    const auto lanes = static_cast<std::size_t>(lanes_);
    for (std::size_t first = 0; first < block.size(); first += lanes)
        march(block.subspan(first, std::min(lanes, block.size() - first)), together_);
    march(block, refilled_);
}

void LaneCount::Slots::add(const Slots& other)
{
    steps += other.steps;
    steps_done += other.steps_done;
    iterations += other.iterations;
    iterations_done += other.iterations_done;
}

ActiveLanes LaneCount::Slots::active() const
{
    return {steps > 0 ? steps_done / steps : 1, iterations > 0 ? iterations_done / iterations : 1};
}

void LaneCount::add(const LaneCount& other)
{
    together_.add(other.together_);
    refilled_.add(other.refilled_);
}

LaneUse LaneCount::use() const { return {lanes_, together_.active(), refilled_.active()}; }

}  // namespace mandelmarch::bench
