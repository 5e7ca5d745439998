// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/studies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

#include "bench/measure/views.h"
#include "bench/statistics/table.h"
#include "core/os/cores.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

using Points = std::vector<Point>;

// Returns a value of Axis::points: a function that returns one point for each of the values of a setting.
template <class Value, class Owner>
auto each(Value Owner::*member, std::vector<std::type_identity_t<Value>> values)
{
    return [member, values](const Case&) {
        Points points;
        for (const Value& value : values) {
            points.push_back({fmt::format("{}", value), [=](Case& one) { one.row.setting.*member = value; }});
        }
        return points;
    };
}

Points sizes(const Case& /*so_far*/)
{
    Points points;
    for (const std::pair<int, int>& size :
         {std::pair(270, 270), {540, 540}, {1080, 1080}, {1920, 1080}, {2160, 2160}, {4096, 2160}}) {
        points.push_back({fmt::format("{}x{}", size.first, size.second),
                          [size](Case& one) { std::tie(one.row.setting.width, one.row.setting.height) = size; }});
    }
    return points;
}

Points iterations(const Case& so_far)
{
    const auto& values = study_of(*so_far.scene.fractal).iterations;
    return each(&Setting::iterations, {values.begin(), values.end()})(so_far);
}

Points thread_counts(const Case& so_far)
{
    const int cores = usable_threads();
    std::vector<int> counts;
    for (int threads = 1; threads < cores; threads *= 2) counts.push_back(threads);
    counts.insert(counts.end(), {cores, 2 * cores});
    return each(&Setting::threads, counts)(so_far);
}

Points disabled(const Case& so_far)
{
    Points points = each(&Setting::without, {"hull", "relaxation", "cones", "neighbours", "trial", "tail", "refinement",
                                             "gradient"})(so_far);
    points.insert(points.begin(), {"none", [](Case&) {}});
    points.push_back({"all-four", [](Case& one) { one.row.setting.without = "hull,relaxation,cones,neighbours"; }});
    return points;
}

Points scenes(const Case& so_far)
{
    Points points;
    for (const View& view : views_of(so_far.scene.fractal->short_name, 1, 1)) {
        points.push_back({std::string(view.name), [name = view.name](Case& one) { one.row.setting.view = name; }});
    }
    return points;
}

bool is_host(const BackendInfo& info) { return info.role == Role::host; }

const std::vector<Mode> both_modes{Mode::exact, Mode::fast};

bool any_backend(const BackendInfo&) { return true; }

// Returns true for the configurations of the study demo: one device of each backend, and the reference in double only.
bool in_demo(const Case& one)
{
    return one.row.device == 0 && (is_swept(one.backend->info()) || one.row.precision == Precision::f64);
}

// A rung of the ladder from the serial reference to the fastest picture.
struct Rung {
    std::string_view name;
    Role role;
    Precision precision;
    Mode mode;
    int threads, simd_width;  // 0: automatic
    std::string_view without;
};
// Optimisations that reduce the number of DE evaluations.
constexpr std::string_view techniques = "hull,relaxation,cones,neighbours,trial,tail";
constexpr Rung rungs[] = {
    {"reference", Role::reference, Precision::f64, Mode::exact, 0, 0, ""},
    {"text", Role::host, Precision::f64, Mode::exact, 1, 1, techniques},
    {"float", Role::host, Precision::f32, Mode::exact, 1, 1, techniques},
    {"simd", Role::host, Precision::f32, Mode::exact, 1, 0, techniques},
    {"operations", Role::host, Precision::f32, Mode::fast, 1, 0, techniques},
    {"estimates", Role::host, Precision::f32, Mode::fast, 1, 0, ""},
    {"threads", Role::host, Precision::f32, Mode::fast, 0, 0, ""},
};

Points rungs_of(const Case& so_far)
{
    Points points;
    for (const Rung& rung : rungs) {
        if (rung.role != so_far.backend->info().role) continue;
        points.push_back({std::string(rung.name), [rung](Case& one) {
                              one.row.setting.threads = rung.threads;
                              one.row.setting.simd_width = rung.simd_width;
                              one.row.setting.without = rung.without;
                          }});
    }
    return points;
}

bool on_a_rung(const Case& one)
{
    return std::ranges::any_of(rungs, [&](const Rung& rung) {
        return one.row.sweep_value == fmt::format("rung={}", rung.name) && one.row.precision == rung.precision &&
               one.row.mode == rung.mode;
    });
}

std::vector<Study> all_studies()
{
    return {
        {.name = standard_study,
         .about = "every fractal, precision, mode, backend and device at one size",
         .measures = any_backend,
         .modes = both_modes,
         .baselines = true},
        {.name = "resolution", .about = "pictures from 270 x 270 to 4096 x 2160", .axes = {{"size", sizes}}},
        {.name = "frames",
         .about = "1 to 100 pictures from a fresh renderer: the cost of opening devices and building kernels",
         .axes = {{"frames", each(&Setting::frames, {1, 2, 5, 10, 30, 100})}},
         .width = 270,  // small enough to render a hundred pictures
         .height = 270},
        {.name = "iterations",
         .about = "the distance estimator's limit of iterations",
         .axes = {{"iterations", iterations}}},
        {.name = "detail",
         .about = "the detail level D",
         .axes = {{"detail", each(&Setting::detail, {-2.0, -2.5, -3.0, -3.5, -4.0, -4.5})}}},
        {.name = "tiles",
         .about = "tiles that a thread takes at once",
         .axes = {{"chunk", each(&Setting::chunk, {1, 2, 4, 8, 16, 32, 64})}},
         .measures = [](const BackendInfo& info) { return info.chunk; }},
        {.name = "bands",
         .about = "pixels that a device renders in one go",
         .axes = {{"band", each(&Setting::band, {1 << 14, 1 << 16, 1 << 18, 1 << 20, 1 << 22})}},
         .measures = [](const BackendInfo& info) { return info.band; },
         .width = 1920,  // large enough for several bands
         .height = 1080},
        {.name = "block-sizes",
         .about = "work items in a group",
         .axes = {{"block-size", each(&Setting::block_size, {32, 64, 128, 256, 512})}},
         .measures = [](const BackendInfo& info) { return info.block_size; }},
        {.name = "resident-warps",
         .about = "warps of a GPU's multiprocessor that render at once",
         .axes = {{"resident-warps", each(&Setting::resident_warps, {8, 12, 16, 20, 36})}},
         .measures = [](const BackendInfo& info) { return info.resident_warps; }},
        {.name = "threads",
         .about = "threads on the host",
         .axes = {{"threads", thread_counts}},
         .measures = [](const BackendInfo& info) { return info.threads; }},
        {.name = "simd-widths",
         .about = "pixels that a core renders at once",
         .axes = {{"simd-width", each(&Setting::simd_width, {1, 2, 4, 8, 16, 24, 32, 48, 64})}},
         .measures = [](const BackendInfo& info) { return info.simd_width; }},
        {.name = "ablation",
         .about = "techniques that make a picture cheaper or better, disabled one by one",
         .axes = {{"without", disabled}},
         .modes = {Mode::fast}},  // some optimisations, such as relaxation, exist in fast mode only
        {.name = "box-vs-bulb",
         .about = "why one fractal is slower: DE evaluations, iterations, operations and idle lanes, in several scenes",
         .axes = {{"scene", scenes}}},
        {.name = ladder_study,
         .about = "from the reference to the fastest picture, one change at a time",
         .axes = {{"rung", rungs_of}},
         .measures = [](const BackendInfo& info) { return info.role == Role::reference || is_host(info); },
         .keeps = on_a_rung,
         .modes = both_modes,
         .counts = false,
         .peaks = false,
         .row_budget = 30},  // the reference needs seconds for one picture
        {.name = demo_study,
         .about = "the standard study, in a minute: one device per backend, few rounds; bin/demo",
         .measures = any_backend,
         .keeps = in_demo,
         .modes = both_modes,
         .baselines = true,
         .counts = false,
         .peaks = false,
         .most_rounds = 5,
         .row_budget = 1},
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
    const auto found = std::ranges::find(studies(), name, &Study::name);
    if (found != studies().end()) return *found;
    throw InputError(
        fmt::format("--study: '{}' given, expected one of {}", name, fmt::join(mapped(studies(), &Study::name), ", ")));
}

}  // namespace mandelmarch::bench
