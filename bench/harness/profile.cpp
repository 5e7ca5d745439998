// SPDX-License-Identifier: Apache-2.0
#include "bench/harness/profile.h"

#include <fmt/format.h>

#include <array>

#include "backends/openmp/profile.h"
#include "core/base/error.h"
#include "core/image/compare.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch::bench {
namespace {

constexpr int usual_repetitions = 7;
constexpr std::array<const char*, openmp::stages> stage_names{"begin", "march", "refine", "normal", "shade", "output"};

// Renders the picture with the registry's openmp backend. The profiled picture must equal it.
Image own_picture(const Registry& registry, const Scene& scene, Precision precision, Mode mode)
{
    const Backend* backend = registry.find("openmp");
    if (backend == nullptr) throw Unavailable("study profile: this build has no backend openmp");
    Image image(scene.width, scene.height, Image::Layers::bytes);
    const RendererOptions options{
        .precision = precision, .mode = mode, .counts = false, .techniques = {.trial = false}};
    backend->create(options)->render(scene, image);
    return image;
}

void verify(const Image& profiled, const Image& own, const std::string& name)
{
    if (profiled.bytes() == own.bytes()) return;
    const Comparison found = compare(own, profiled);
    throw Error(fmt::format("study profile: {}: the picture is wrong: {} of {} pixels differ from openmp's own", name,
                            found.differing, found.pixels));
}

void add(std::vector<StageTime>& times, const Registry& registry, const Scene& scene, Precision precision, Mode mode,
         int repetitions)
{
    const Image own = own_picture(registry, scene, precision, mode);
    const auto profiler = openmp::make_profiler(scene, precision, mode);
    const std::string name = fmt::format("{}, {}, {}", scene.fractal->name, name_of(precision), name_of(mode));
    const std::size_t first = times.size();
    for (const char* stage : stage_names)
        times.push_back({std::string(scene.fractal->name), precision, mode, stage, {}});
    times.push_back({std::string(scene.fractal->name), precision, mode, in_one_go, {}});
    for (int i = 0; i <= repetitions; ++i) {
        Image image(scene.width, scene.height, Image::Layers::bytes);
        const openmp::StageSeconds seconds = profiler->draw(image);
        verify(image, own, name);
        if (i == 0) continue;  // warm-up
        for (std::size_t stage = 0; stage < seconds.of.size(); ++stage) {
            times[first + stage].seconds.push_back(seconds.of.at(stage));
        }
        times.back().seconds.push_back(seconds.in_one_go);
    }
}

}  // namespace

std::vector<StageTime> profile(const Registry& registry, const Options& options, const Phase& phase)
{
    std::vector<StageTime> times;
    const auto [width, height] = options.picture_size();
    const int repetitions = options.repetitions.value_or(usual_repetitions);
    for (const Fractal* fractal : options.fractals) {
        const Scene scene = official_scene(*fractal, width, height);
        for (const Precision precision : options.precisions) {
            for (const Mode mode : options.selected_modes()) {
                phase({"profile", 0, std::string(fractal->short_name)});
                add(times, registry, scene, precision, mode, repetitions);
            }
        }
    }
    return times;
}

}  // namespace mandelmarch::bench
