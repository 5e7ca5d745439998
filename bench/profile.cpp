#include "bench/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>

#include "bench/stage_kernels.h"
#include "bench/study.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int usual_repetitions = 7;
// The last one is the whole pixel without a stop, output included, as the openmp backend draws it.
constexpr std::array<const char*, timed_stages + 1> stage_names{"begin", "march",  "refine", "normal",
                                                                "shade", "output", in_one_go};

using Seconds = std::array<double, timed_stages + 1>;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// One picture, tile by tile, so that the stored rays stay in the cache; the clock is read between the stages of a tile.
template <class Real>
Seconds draw_once(const StageKernel<Real>& kernel, const void* scene, void* stored, Image& image)
{
    Seconds seconds{};
    Tile<Real> tile;
    for (int bottom = 0; bottom < image.height(); bottom += tile_side) {
        for (int left = 0; left < image.width(); left += tile_side) {
            const auto store = [&] {
                image.store(planes_of(tile), left, bottom, std::min(tile_side, image.width() - left),
                            std::min(tile_side, image.height() - bottom));
            };
            for (int stage = 0; stage < timed_stages; ++stage) {
                const auto start = Clock::now();
                kernel.run(static_cast<TimedStage>(stage), scene, left, bottom, stored, tile);
                if (static_cast<TimedStage>(stage) == TimedStage::output) store();
                seconds.at(static_cast<std::size_t>(stage)) += seconds_since(start);
            }
            const auto start = Clock::now();
            kernel.draw(scene, left, bottom, tile);
            store();
            seconds.back() += seconds_since(start);
        }
    }
    return seconds;
}

template <class Real, class KernelScene>
void add(std::vector<StageTime>& times, const Scene& scene, Precision precision, Mode mode, int repetitions)
{
    const StageKernel<Real> kernel = stage_kernel<Real>(scene.fractal->name, mode);
    const KernelScene data = kernel_scene<KernelScene>(scene, mode);
    // The packs' alignment is 64 at most; aligned_alloc wants a multiple of it.
    const std::unique_ptr<void, decltype(&std::free)> stored(std::aligned_alloc(64, (kernel.bytes + 63) / 64 * 64),
                                                             &std::free);
    if (stored == nullptr) throw std::bad_alloc();
    Image image(scene.width, scene.height, Image::Layers::bytes);
    draw_once(kernel, &data, stored.get(), image);  // warms up
    const std::size_t first = times.size();
    for (const char* name : stage_names) {
        times.push_back({std::string(scene.fractal->name), precision, mode, name, {}});
    }
    for (int i = 0; i < repetitions; ++i) {
        const Seconds seconds = draw_once(kernel, &data, stored.get(), image);
        for (std::size_t stage = 0; stage < seconds.size(); ++stage) {
            times[first + stage].seconds.push_back(seconds.at(stage));
        }
    }
}

}  // namespace

std::vector<StageTime> profile(const Options& options, const Phase& phase)
{
    std::vector<StageTime> times;
    const auto [width, height] = size_of(options);
    const int repetitions = options.repetitions.value_or(usual_repetitions);
    for (const std::string& nickname : fractals_of(options)) {
        const Scene scene = official_scene_of(nickname, width, height);
        for (const Precision precision : precisions_of(options)) {
            for (const Mode mode : modes_of(options)) {
                phase(fmt::format("profile, {}", nickname), 0);
                if (precision == Precision::f32) {
                    add<float, layout_f32::Scene>(times, scene, precision, mode, repetitions);
                } else {
                    add<double, layout_f64::Scene>(times, scene, precision, mode, repetitions);
                }
            }
        }
    }
    return times;
}

}  // namespace mandelmarch::bench
