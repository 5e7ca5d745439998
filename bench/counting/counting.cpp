// SPDX-License-Identifier: Apache-2.0
#include "bench/counting/counting.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "flight/field/threads.h"

namespace mandelmarch::bench {
namespace {

constexpr int block_side = 16;  // pixels

// Calls each(column, row) for the pixels of a square patch inside the picture, along Morton's curve: each aligned group
// of 2^n consecutive pixels fills a rectangle with as many columns as rows, or twice as many.
template <class Each>
void each_pixel(int first_column, int first_row, const Scene& scene, const Each& each)
{
    for (int at = 0; at < block_side * block_side; ++at) {
        int column = first_column;
        int row = first_row;
        for (int bit = 0; 1 << bit < block_side; ++bit) {
            column += (at >> 2 * bit & 1) << bit;
            row += (at >> (2 * bit + 1) & 1) << bit;
        }
        if (column < scene.width && row < scene.height) each(column, row);
    }
}

struct BlockCount {
    Count count;
    std::vector<LaneCount> lanes;
};

template <class Real>
Count counted(const Scene& scene, const CountOptions& options)
{
    CountOperations<Real>* const count_pixel =
        operation_counter<Real>(fmt::format("{}_{}", scene.fractal->name, name_of(options.precision)));
    if (count_pixel == nullptr) {
        throw Unavailable(fmt::format("no operations are counted for the {}", scene.fractal->name));
    }
    const auto kernel = kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques);
    const auto columns = static_cast<std::size_t>((scene.width + block_side - 1) / block_side);
    const auto rows = static_cast<std::size_t>((scene.height + block_side - 1) / block_side);
    const auto pixels = static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
    // Every stride-th block is counted. If the stride and the columns have no common divisor, all columns are counted.
    std::size_t stride = (pixels + options.most_pixels - 1) / options.most_pixels;
    while (std::gcd(stride, columns) > 1) ++stride;
    std::vector<BlockCount> blocks((columns * rows + stride - 1) / stride);
    parallel(blocks.size(), 1, 0, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto column = static_cast<int>(i * stride % columns);
            const auto row = static_cast<int>(i * stride / columns);
            Count& count = blocks[i].count;
            PixelCount sums;
            std::vector<RaySteps> rays;
            each_pixel(block_side * column, block_side * row, scene, [&](int x, int y) {
                rays.push_back(count_pixel(kernel, x, y, sums));
                count.march_estimates += rays.back().size();
                for (const int iterations : rays.back()) count.march_iterations += static_cast<unsigned>(iterations);
            });
            count.stages = sums.stages;
            count.work = sums.work;
            count.hits = sums.hits;
            count.pixels = rays.size();
            for (const int lanes : options.lanes) blocks[i].lanes.emplace_back(lanes).add(rays);
        }
    });
    BlockCount sum{{}, {options.lanes.begin(), options.lanes.end()}};
    for (const BlockCount& block : blocks) {
        sum.count += block.count;
        for (std::size_t i = 0; i < sum.lanes.size(); ++i) sum.lanes[i].add(block.lanes[i]);
    }
    for (const LaneCount& lanes : sum.lanes) sum.count.lane_use.push_back(lanes.use());
    return std::move(sum.count);
}

}  // namespace

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

Count& Count::operator+=(const Count& other)
{
    for (std::size_t i = 0; i < stages.size(); ++i) stages[i] = stages[i] + other.stages[i];
    work += other.work;
    pixels += other.pixels;
    hits += other.hits;
    march_estimates += other.march_estimates;
    march_iterations += other.march_iterations;
    return *this;
}

Count count_operations(const Scene& scene, const CountOptions& options)
{
    return options.precision == Precision::f32 ? counted<float>(scene, options) : counted<double>(scene, options);
}

}  // namespace mandelmarch::bench
