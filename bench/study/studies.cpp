// SPDX-License-Identifier: Apache-2.0
#include "bench/study/studies.h"

#include <fmt/format.h>

#include <tuple>
#include <utility>

#include "bench/study/views.h"
#include "core/base/cores.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

using Points = std::vector<Point>;

// Returns the points of a setting's values, the same for all fractals.
template <class Member, class Value>
auto each(Member member, std::vector<Value> values)
{
    return [member, values](const Fractal&) {
        Points points;
        for (const Value& value : values) {
            points.push_back({fmt::format("{}", value), [=](Setting& setting) { setting.*member = value; }});
        }
        return points;
    };
}

Points sizes(const Fractal& /*fractal*/)
{
    Points points;
    for (const std::pair<int, int>& size :
         {std::pair(270, 270), {540, 540}, {1080, 1080}, {1920, 1080}, {2160, 2160}, {4096, 2160}}) {
        points.push_back({fmt::format("{}x{}", size.first, size.second),
                          [size](Setting& setting) { std::tie(setting.width, setting.height) = size; }});
    }
    return points;
}

Points iterations(const Fractal& fractal)
{
    const auto& values = fractal.study.iterations;
    return each(&Setting::iterations, std::vector<int>(values.begin(), values.end()))(fractal);
}

Points thread_counts(const Fractal& fractal)
{
    const int cores = usable_threads();
    std::vector<int> counts;
    for (int threads = 1; threads < cores; threads *= 2) counts.push_back(threads);
    counts.insert(counts.end(), {cores, 2 * cores});
    return each(&Setting::threads, counts)(fractal);
}

Points disabled(const Fractal& fractal)
{
    Points points =
        each(&Setting::without, std::vector<std::string>{"hull", "relaxation", "cones", "neighbours", "trial", "tail",
                                                         "refinement", "gradient"})(fractal);
    points.insert(points.begin(), {"none", [](Setting&) {}});
    points.push_back({"all-four", [](Setting& setting) { setting.without = "hull,relaxation,cones,neighbours"; }});
    return points;
}

Points scenes(const Fractal& fractal)
{
    Points points;
    for (const View& view : views_of(fractal.short_name, 1, 1)) {
        points.push_back({std::string(view.name), [name = std::string(view.name)](Setting& s) { s.view = name; }});
    }
    return points;
}

// The profiled stages are those of openmp (profile.h).
bool is_host(const BackendInfo& info) { return info.role == Role::host; }

const std::vector<Mode> both_modes{Mode::exact, Mode::fast};

std::vector<Study> all_studies()
{
    return {
        {.name = standard_study,
         .about = "every fractal, precision, mode, backend and device at one size",
         .measures = [](const BackendInfo&) { return true; },
         .modes = both_modes},
        {.name = "resolution", .about = "pictures from 270 x 270 to 4096 x 2160", .axis = "size", .points = sizes},
        {.name = "frames",
         .about = "1 to 100 pictures from a fresh renderer: what opening and building cost",
         .axis = "frames",
         .points = each(&Setting::frames, std::vector{1, 2, 5, 10, 30, 100}),
         .width = 270,  // small enough to render a hundred pictures
         .height = 270},
        {.name = "iterations",
         .about = "the distance estimator's limit of iterations",
         .axis = "iterations",
         .points = iterations},
        {.name = "detail",
         .about = "the detail level D",
         .axis = "detail",
         .points = each(&Setting::detail, std::vector{-2.0, -2.5, -3.0, -3.5, -4.0, -4.5})},
        {.name = "tiles",
         .about = "tiles that a thread takes at once",
         .axis = "chunk",
         .points = each(&Setting::chunk, std::vector{1, 2, 4, 8, 16, 32, 64}),
         .measures = [](const BackendInfo& info) { return info.chunk; }},
        {.name = "bands",
         .about = "pixels that a device draws in one go",
         .axis = "band",
         .points = each(&Setting::band, std::vector{1 << 14, 1 << 16, 1 << 18, 1 << 20, 1 << 22}),
         .measures = [](const BackendInfo& info) { return info.band; },
         .width = 1920,  // large enough for several bands
         .height = 1080},
        {.name = "block-sizes",
         .about = "threads of a GPU's block, work items of a group",
         .axis = "block-size",
         .points = each(&Setting::block_size, std::vector{32, 64, 128, 256, 512}),
         .measures = [](const BackendInfo& info) { return info.block_size; }},
        {.name = "threads",
         .about = "threads on the host",
         .axis = "threads",
         .points = thread_counts,
         .measures = [](const BackendInfo& info) { return info.threads; }},
        {.name = "simd-widths",
         .about = "pixels at once on a core",
         .axis = "simd-width",
         .points = each(&Setting::simd_width, std::vector{1, 2, 4, 8, 16, 24, 32, 48, 64}),
         .measures = [](const BackendInfo& info) { return info.simd_width; }},
        {.name = "ablation",
         .about = "what makes a picture cheaper or better, disabled one by one",
         .axis = "without",
         .points = disabled,
         .modes = {Mode::fast}},  // some optimisations, such as relaxation, exist in fast mode only
        {.name = "profile",
         .about = "where a picture's time goes: begin, march, refine, normal, shade, output",
         .measures = is_host,
         .modes = both_modes},
        {.name = "box-vs-bulb",
         .about = "why one fractal is slower: calls, iterations, operations and idle lanes, in several scenes",
         .axis = "scene",
         .points = scenes},
    };
}

}  // namespace

const std::vector<Study>& studies()
{
    static const std::vector<Study> all = all_studies();
    return all;
}

const Study& study_named(std::string_view name)
{
    std::string known;
    for (const Study& study : studies()) {
        if (study.name == name) return study;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", study.name);
    }
    throw InputError(fmt::format("--study: '{}' given, expected one of {}", name, known));
}

}  // namespace mandelmarch::bench
