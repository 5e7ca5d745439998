// SPDX-License-Identifier: Apache-2.0
#include "bench/counting/counting.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "bench/statistics/statistics.h"
#include "core/text/error.h"
#include "core/scene/fractal.h"
#include "flight/field/threads.h"

namespace mandelmarch::bench {
namespace {

// Counts of one patch.
struct BlockCount {
    PixelCount pixels;
    std::vector<LaneCount> lanes{};
    std::uint64_t drawn = 0, steps = 0, iterations = 0;  // rendered pixels; steps of the march, and their DE iterations

    Operations operations() const { return std::accumulate(pixels.stages.begin(), pixels.stages.end(), Operations{}); }
};

Count together(const std::vector<BlockCount>& blocks, const CountOptions& options, bool every_pixel)
{
    Count count;
    std::vector<Part> by_iteration;
    std::vector<Part> by_estimate;
    for (const BlockCount& block : blocks) {
        for (std::size_t i = 0; i < count.stages.size(); ++i)
            count.stages[i] = count.stages[i] + block.pixels.stages[i];
        count.work += block.pixels.work;
        count.pixels += block.drawn;
        count.hits += block.pixels.hits;
        count.march_estimates += block.steps;
        count.march_iterations += block.iterations;
        by_iteration.push_back(
            {static_cast<double>(block.operations().total()), static_cast<double>(block.pixels.work.iterations)});
        by_estimate.push_back({static_cast<double>(block.iterations), static_cast<double>(block.steps)});
    }
    for (std::size_t i = 0; i < options.lanes.size(); ++i) {
        std::vector<LaneCount> of_blocks;
        of_blocks.reserve(blocks.size());
        for (const BlockCount& block : blocks) of_blocks.push_back(block.lanes[i]);
        count.lane_use.push_back(LaneCount::use(of_blocks, every_pixel));
    }
    count.errors = CountErrors{};
    if (!every_pixel) {
        count.errors = {.per_iteration = ratio_of_sums(by_iteration).standard_error,
                        .per_estimate = ratio_of_sums(by_estimate).standard_error};
    }
    return count;
}

template <class Real>
Count counted(const Scene& scene, const CountOptions& options, std::span<const Block> blocks, bool every_pixel)
{
    CountOperations<Real>* const count_pixel =
        operation_counter<Real>(fmt::format("{}_{}", scene.fractal->name, name_of(options.precision)));
    if (count_pixel == nullptr) {
        throw Unavailable(fmt::format("no operations are counted for the {}", scene.fractal->name));
    }
    const auto kernel = kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques);
    std::vector<BlockCount> counts(blocks.size());
    parallel(blocks.size(), 1, 0, [&](std::size_t first, std::size_t last) {
        for (std::size_t block = first; block < last; ++block) {
            BlockCount mine;
            std::vector<RaySteps> rays;
            each_pixel(blocks[block], scene.width, scene.height, [&](int column, int row) {
                rays.push_back(count_pixel(kernel, column, row, mine.pixels));
                mine.steps += rays.back().size();
                for (const int iterations : rays.back()) mine.iterations += static_cast<unsigned>(iterations);
            });
            for (const int lanes : options.lanes) mine.lanes.emplace_back(lanes).add(rays);
            mine.drawn = rays.size();
            counts[block] = std::move(mine);
        }
    });
    return together(counts, options, every_pixel);
}

}  // namespace

Count count_operations(const Scene& scene, const CountOptions& options)
{
    if (std::int64_t{scene.width} * scene.height <= options.most_pixels)
        return count_operations(scene, options, all_blocks(scene.width, scene.height), true);
    CountOptions without_lanes = options;
    without_lanes.lanes.clear();
    Count count =
        count_operations(scene, without_lanes, sample_of_pixels(scene.width, scene.height, options.most_pixels), false);
    count.lane_use =
        count_operations(scene, options, sample_of_blocks(scene.width, scene.height, options.most_pixels), false)
            .lane_use;
    return count;
}

Count count_operations(const Scene& scene, const CountOptions& options, std::span<const Block> blocks, bool every_pixel)
{
    return options.precision == Precision::f32 ? counted<float>(scene, options, blocks, every_pixel)
                                               : counted<double>(scene, options, blocks, every_pixel);
}

}  // namespace mandelmarch::bench
