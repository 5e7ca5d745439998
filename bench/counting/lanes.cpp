// SPDX-License-Identifier: Apache-2.0
#include "bench/counting/lanes.h"

#include <algorithm>
#include <cstddef>

#include "bench/statistics/statistics.h"

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

std::pair<ActiveLanes, ActiveLanes> LaneCount::active(std::span<const LaneCount> blocks, Slots LaneCount::*slots)
{
    std::vector<Part> steps;
    std::vector<Part> iterations;
    for (const LaneCount& block : blocks) {
        const Slots& s = block.*slots;
        steps.push_back({s.steps_done, s.steps});
        iterations.push_back({s.iterations_done, s.iterations});
    }
    const PartRatio of_steps = ratio_of_sums(steps);
    const PartRatio of_iterations = ratio_of_sums(iterations);
    return {{of_steps.ratio.value_or(1), of_iterations.ratio.value_or(1)},
            {of_steps.standard_error, of_iterations.standard_error}};
}

LaneUse LaneCount::use(std::span<const LaneCount> blocks, bool every_pixel)
{
    const auto [together, together_error] = active(blocks, &LaneCount::together_);
    const auto [refilled, refilled_error] = active(blocks, &LaneCount::refilled_);
    constexpr ActiveLanes none{0, 0};
    return {.lanes = blocks.empty() ? 0 : blocks.front().lanes_,
            .together = together,
            .refilled = refilled,
            .together_error = every_pixel ? none : together_error,
            .refilled_error = every_pixel ? none : refilled_error};
}

}  // namespace mandelmarch::bench
