// SPDX-License-Identifier: Apache-2.0
#include "bench/lanes.h"

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

void LaneCount::add(const LaneCount& other)
{
    const auto add = [](Slots& to, const Slots& from) {
        to.steps += from.steps;
        to.steps_done += from.steps_done;
        to.iterations += from.iterations;
        to.iterations_done += from.iterations_done;
    };
    add(together_, other.together_);
    add(refilled_, other.refilled_);
}

ActiveLanes LaneCount::active(const Slots& slots)
{
    const auto share = [](double part, double whole) { return whole == 0 ? 1 : part / whole; };
    return {share(slots.steps_done, slots.steps), share(slots.iterations_done, slots.iterations)};
}

LaneUse LaneCount::use() const { return {lanes_, active(together_), active(refilled_)}; }

}  // namespace mandelmarch::bench
