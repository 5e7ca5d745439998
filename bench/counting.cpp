// SPDX-License-Identifier: Apache-2.0
#include "bench/counting.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "bench/counting_kernel.h"
#include "core/base/error.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

// Packs of `lanes` neighbouring pixels, spread evenly over the picture where it has more pixels than are asked for.
class Packs {
public:
    Packs(const Scene& scene, int lanes, std::int64_t most_pixels) : scene_(scene)
    {
        while (width_ * width_ < lanes) width_ *= 2;
        height_ = std::max(1, lanes / width_);
        const double pixels = static_cast<double>(scene.width) * scene.height;
        const auto every = static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(most_pixels))));
        step_x_ = width_ * std::max(1, every);
        step_y_ = height_ * std::max(1, every);
        columns_ = (scene.width + step_x_ - 1) / step_x_;
        rows_ = (scene.height + step_y_ - 1) / step_y_;
    }

    int count() const { return columns_ * rows_; }

    // The pixels inside the picture.
    std::vector<PixelPlace> pixels(int pack) const
    {
        std::vector<PixelPlace> places;
        const int left = pack % columns_ * step_x_;
        const int bottom = pack / columns_ * step_y_;
        for (int j = bottom; j < std::min(bottom + height_, scene_.height); ++j) {
            for (int i = left; i < std::min(left + width_, scene_.width); ++i) places.push_back({i, j});
        }
        return places;
    }

private:
    const Scene& scene_;
    int width_ = 1, height_ = 1;   // of a pack, pixels
    int step_x_ = 1, step_y_ = 1;  // from pack to pack
    int columns_ = 1, rows_ = 1;   // of packs
};

void add(PackCount& to, const PackCount& from)
{
    for (std::size_t i = 0; i < to.stages.size(); ++i) to.stages[i] = to.stages[i] + from.stages[i];
    to.work += from.work;
    to.hits += from.hits;
    to.step_slots += from.step_slots;
    to.steps += from.steps;
    to.iteration_slots += from.iteration_slots;
    to.iterations += from.iterations;
}

double share(std::uint64_t part, std::uint64_t whole)
{
    return whole == 0 ? 1 : static_cast<double>(part) / static_cast<double>(whole);
}

template <class KernelScene>
Count counted(const Scene& scene, const CountOptions& options, CountPack count_pack)
{
    const KernelScene kernel = kernel_scene<KernelScene>(scene, options.mode, options.techniques);
    const Packs packs(scene, options.lanes, options.most_pixels);
    const unsigned workers = std::max(1U, std::thread::hardware_concurrency());
    std::vector<PackCount> sums(workers);
    std::atomic<int> next = 0;
    std::atomic<std::uint64_t> pixels = 0;
    {
        std::vector<std::jthread> threads;
        threads.reserve(sums.size());
        for (PackCount& sum : sums) {
            threads.emplace_back([&] {
                PackCount mine;
                for (int pack = next++; pack < packs.count(); pack = next++) {
                    const auto places = packs.pixels(pack);
                    count_pack(&kernel, places, mine);
                    pixels += places.size();
                }
                sum = mine;
            });
        }
    }
    PackCount all;
    for (const PackCount& sum : sums) add(all, sum);
    Count count;
    count.stages = all.stages;
    count.work = all.work;
    count.pixels = pixels;
    count.hits = all.hits;
    count.lanes = options.lanes;
    count.active_in_steps = share(all.steps, all.step_slots);
    count.active_in_iterations = share(all.iterations, all.iteration_slots);
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
