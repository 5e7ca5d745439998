// SPDX-License-Identifier: Apache-2.0
#include "bench/counting.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "bench/counting_kernel.h"
#include "core/base/cores.h"
#include "core/base/error.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

constexpr int block_side = 16;  // pixels

// Blocks of pixels, spread evenly over the picture where it has more pixels than are asked for.
class Blocks {
public:
    Blocks(const Scene& scene, std::int64_t most_pixels) : scene_(scene)
    {
        const double pixels = static_cast<double>(scene.width) * scene.height;
        const auto every = static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(most_pixels))));
        step_ = block_side * std::max(1, every);
        columns_ = (scene.width + step_ - 1) / step_;
        rows_ = (scene.height + step_ - 1) / step_;
    }

    int count() const { return columns_ * rows_; }

    // Calls each(i, j) for the block's pixels inside the picture, along Morton's curve: a power of two of them fills a
    // rectangle of at most twice as many columns as rows.
    template <class Each>
    void each_pixel(int block, Each each) const
    {
        const int left = block % columns_ * step_;
        const int bottom = block / columns_ * step_;
        for (int at = 0; at < block_side * block_side; ++at) {
            int i = left;
            int j = bottom;
            for (int bit = 0; 1 << bit < block_side; ++bit) {
                i += (at >> 2 * bit & 1) << bit;
                j += (at >> (2 * bit + 1) & 1) << bit;
            }
            if (i < scene_.width && j < scene_.height) each(i, j);
        }
    }

private:
    const Scene& scene_;
    int step_ = 1;                // from block to block
    int columns_ = 1, rows_ = 1;  // of blocks
};

// What one thread counts.
struct Sum {
    PixelCount pixels;
    std::vector<LaneCount> lanes;
    std::uint64_t drawn = 0, steps = 0, iterations = 0;  // steps and iterations of the march

    explicit Sum(const CountOptions& options) : lanes(options.lanes.begin(), options.lanes.end()) {}

    void add(const Sum& from)
    {
        for (std::size_t i = 0; i < pixels.stages.size(); ++i)
            pixels.stages[i] = pixels.stages[i] + from.pixels.stages[i];
        pixels.work += from.pixels.work;
        pixels.hits += from.pixels.hits;
        for (std::size_t i = 0; i < lanes.size(); ++i) lanes[i].add(from.lanes[i]);
        drawn += from.drawn;
        steps += from.steps;
        iterations += from.iterations;
    }
};

template <class KernelScene>
Count counted(const Scene& scene, const CountOptions& options, CountPixel count_pixel)
{
    const KernelScene kernel = kernel_scene<KernelScene>(scene, options.mode, options.techniques);
    const Blocks blocks(scene, options.most_pixels);
    std::vector<Sum> sums(static_cast<std::size_t>(usable_threads()), Sum(options));
    std::atomic<int> next = 0;
    {
        std::vector<std::jthread> threads;
        threads.reserve(sums.size());
        for (Sum& sum : sums) {
            threads.emplace_back([&] {
                Sum mine(options);
                for (int block = next++; block < blocks.count(); block = next++) {
                    std::vector<RaySteps> rays;
                    blocks.each_pixel(block, [&](int i, int j) {
                        count_pixel(&kernel, i, j, mine.pixels, rays.emplace_back());
                        mine.steps += rays.back().size();
                        for (const int iterations : rays.back()) mine.iterations += static_cast<unsigned>(iterations);
                    });
                    for (LaneCount& lanes : mine.lanes) lanes.add(rays);
                    mine.drawn += rays.size();
                }
                sum = mine;
            });
        }
    }
    Sum all(options);
    for (const Sum& sum : sums) all.add(sum);
    Count count;
    count.stages = all.pixels.stages;
    count.work = all.pixels.work;
    count.pixels = all.drawn;
    count.hits = all.pixels.hits;
    for (const LaneCount& lanes : all.lanes) count.lane_use.push_back(lanes.use());
    count.march_estimates = all.steps;
    count.march_iterations = all.iterations;
    return count;
}

}  // namespace

Count count_operations(const Scene& scene, const CountOptions& options)
{
    const CountingKernel* kernel = counting_kernel(scene.fractal->name);
    if (kernel == nullptr) throw Unavailable(fmt::format("no operations are counted for the {}", scene.fractal->name));
    return options.precision == Precision::f32 ? counted<layout_f32::Scene>(scene, options, kernel->in_float)
                                               : counted<layout_f64::Scene>(scene, options, kernel->in_double);
}

}  // namespace mandelmarch::bench
