// SPDX-License-Identifier: Apache-2.0
#include "bench/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>

#include "backends/openmp/spacing.h"
#include "backends/openmp/threads.h"
#include "bench/stage_kernels.h"
#include "bench/study.h"
#include "bench/views.h"
#include "core/base/error.h"
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

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

// Tiles of a picture, one after the other.
struct TileList {
    int columns, count;
    int next = 0;

    openmp::Tiles tiles()
    {
        next = 0;
        return {[](void* source, int& left, int& bottom) {
                    auto& list = *static_cast<TileList*>(source);
                    if (list.next >= list.count) return false;
                    left = list.next % list.columns * tile_side;
                    bottom = list.next / list.columns * tile_side;
                    ++list.next;
                    return true;
                },
                this};
    }
};

// A picture on its way, in one thread's memory.
template <class Real>
class Profiler {
public:
    Profiler(const StageKernel<Real>& kernel, const Scene& scene)
        : kernel_(kernel),
          image_(scene.width, scene.height, Image::Layers::bytes),
          // aligned_alloc wants a multiple of the alignment.
          memory_(std::aligned_alloc(64, (kernel.bytes + 63) / 64 * 64), &std::free),
          tiles_{.columns = (scene.width + tile_side - 1) / tile_side, .count = 0}
    {
        if (memory_ == nullptr) throw std::bad_alloc();
        tiles_.count = tiles_.columns * ((scene.height + tile_side - 1) / tile_side);
    }

    template <class KernelScene>
    Seconds draw(const KernelScene& scene, const Fractal& fractal)
    {
        Seconds seconds{};
        notes_.fit(image_.width(), image_.height());
        openmp::Canvas<Real> canvas{.first_row = 0,
                                    .end_row = image_.height(),
                                    .pixels = static_cast<std::ptrdiff_t>(image_.pixels()),
                                    .spacing = openmp::spacing_of(scene),
                                    .cones = openmp::cones_pay(scene, fractal, {}),
                                    .block_hull = openmp::block_hull_of(scene, fractal),
                                    .lattice = {},
                                    .starts = notes_.starts.data(),
                                    .hits = notes_.hits.data(),
                                    .reals = nullptr,
                                    .wholes = nullptr,
                                    .bytes = image_.bytes().data()};
        const openmp::Lattices lattices = openmp::lattices_of(scene, fractal, {});
        for (const openmp::Lattice& lattice : lattices) {
            canvas.lattice = lattice;
            kernel_.profile(&scene, canvas, tiles_.tiles(), memory_.get(), &now, seconds.data());
        }
        const double start = now();
        for (const openmp::Lattice& lattice : lattices) {
            canvas.lattice = lattice;
            kernel_.draw(&scene, canvas, tiles_.tiles(), memory_.get());
        }
        seconds.back() = now() - start;
        return seconds;
    }

private:
    StageKernel<Real> kernel_;
    Image image_;
    std::unique_ptr<void, decltype(&std::free)> memory_;
    TileList tiles_;
    openmp::Notes<Real> notes_;
};

template <class Real, class KernelScene>
void add(std::vector<StageTime>& times, const Scene& scene, Precision precision, Mode mode, int repetitions)
{
    const StageKernel<Real> kernel = stage_kernel<Real>(scene.fractal->name, mode);
    if (kernel.profile == nullptr)
        throw Unavailable("study profile: openmp has no packs on this machine, only scalars");
    const KernelScene data = kernel_scene<KernelScene>(scene, mode);
    Profiler<Real> profiler(kernel, scene);
    profiler.draw(data, *scene.fractal);  // warms up
    const std::size_t first = times.size();
    for (const char* name : stage_names) {
        times.push_back({std::string(scene.fractal->name), precision, mode, name, {}});
    }
    for (int i = 0; i < repetitions; ++i) {
        const Seconds seconds = profiler.draw(data, *scene.fractal);
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
    for (const std::string& nickname : fractals_of(options.fractal)) {
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
