// SPDX-License-Identifier: Apache-2.0
#include "bench/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <regex>
#include <tuple>

#include "cli/option_values.h"
#include "bench/views.h"
#include "core/base/cores.h"
#include "core/base/cpu.h"
#include "core/base/error.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

constexpr int usual_side = 540;   // pixels
constexpr int frames_side = 270;  // small enough to render a hundred pictures

constexpr std::array<Study, 13> all_studies{{
    {standard_study, "", "every fractal, precision, mode, backend and device at one size"},
    {"resolution", "pixels", "pictures from 270 x 270 to 4096 x 2160"},
    {"frames", "frames", "1 to 100 pictures from a fresh renderer: what opening and building cost"},
    {"iterations", "iterations", "the distance estimator's limit of iterations"},
    {"detail", "detail", "the detail level D"},
    {"tiles", "chunk", "tiles that a thread takes at once"},
    {"bands", "band", "pixels that a device draws in one go"},
    {"blocks", "block", "threads of a GPU's block, work items of a group"},
    {"threads", "threads", "threads on the host"},
    {"packs", "pack", "pixels at once on a core"},
    {"ablation", "without", "what makes a picture cheaper or better, switched off one by one"},
    {"profile", "", "where a picture's time goes: begin, march, refine, normal, shade, output"},
    {"box-vs-bulb", "scene",
     "why one fractal is slower: calls, iterations, operations and idle lanes, in several scenes"},
}};

// A sweep value, and the settings that it changes.
struct Point {
    std::string name;
    Setting change;  // only members other than 0 apply
};

std::vector<Point> points_of(std::string_view study, std::string_view short_name)
{
    const auto points = [](std::string_view name, int Setting::*member, std::span<const int> values) {
        std::vector<Point> made;
        for (const int value : values) {
            made.push_back({fmt::format("{}={}", name, value), {}});
            made.back().change.*member = value;
        }
        return made;
    };
    if (study == "resolution") {
        std::vector<Point> made;
        for (const auto& [columns, rows] :
             {std::pair(270, 270), {540, 540}, {1080, 1080}, {1920, 1080}, {2160, 2160}, {4096, 2160}}) {
            made.push_back({fmt::format("size={}x{}", columns, rows), {.width = columns, .height = rows}});
        }
        return made;
    }
    if (study == "frames") return points("frames", &Setting::frames, std::array{1, 2, 5, 10, 30, 100});
    if (study == "iterations") {
        return points("iterations", &Setting::iterations, fractal_named(short_name).study.iterations);
    }
    if (study == "detail") {
        std::vector<Point> made;
        for (const double detail : {-2.0, -2.5, -3.0, -3.5, -4.0, -4.5}) {
            made.push_back({fmt::format("detail={}", detail), {.detail = detail}});
        }
        return made;
    }
    if (study == "tiles") return points("chunk", &Setting::chunk, std::array{1, 2, 4, 8, 16, 32, 64});
    if (study == "bands") {
        return points("band", &Setting::band, std::array{1 << 14, 1 << 16, 1 << 18, 1 << 20, 1 << 22});
    }
    if (study == "blocks") return points("block", &Setting::block, std::array{32, 64, 128, 256, 512});
    if (study == "packs") return points("pack", &Setting::pack, std::array{1, 2, 4, 8, 16, 24, 32, 48, 64});
    if (study == "ablation") {
        std::vector<Point> made{{"without=none", {}}};
        for (const char* technique : {"hull", "relaxation", "cones", "neighbours", "trial", "tail", "root", "normal"}) {
            made.push_back({fmt::format("without={}", technique), {.without = technique}});
        }
        made.push_back({"without=all-four", {.without = "hull,relaxation,cones,neighbours"}});
        return made;
    }
    if (study == "threads") {
        std::vector<Point> made;
        const int cores = usable_threads();
        for (int threads = 1; threads < cores; threads *= 2) {
            made.push_back({fmt::format("threads={}", threads), {.threads = threads}});
        }
        for (const int threads : {cores, 2 * cores}) {
            made.push_back({fmt::format("threads={}", threads), {.threads = threads}});
        }
        return made;
    }
    if (study == "box-vs-bulb") {
        std::vector<Point> made;
        for (const View& view : views_of(short_name, 1, 1)) {
            made.push_back({fmt::format("scene={}", view.name), {.view = std::string(view.name)}});
        }
        return made;
    }
    return {{"", {}}};
}

// Returns the sweep values of the study. In the standard study, the backend with the role host also gets the scalar
// kernel as a baseline: a speed-up over it cannot come from another program or from more threads.
std::vector<Point> points_for(const Options& options, std::string_view short_name, const BackendInfo& info)
{
    std::vector<Point> points = points_of(options.study, short_name);
    if (options.baselines && options.study == standard_study && info.role == Role::host && info.pack)
        points.push_back({"pack=1", {.pack = 1}});
    return points;
}

// Returns true for the baselines of the standard study, which are measured even if --backend does not name them.
bool is_baseline(const BackendInfo& info, const Point& point, Precision precision, Mode mode)
{
    if (info.role == Role::reference) return precision == Precision::f64 && mode == Mode::exact;
    return info.role == Role::host && point.change.pack == 1;
}

// Returns true if the study measures this backend, for example because the backend has the option that is varied.
bool takes_part(std::string_view study, const BackendInfo& info)
{
    if (study == "tiles") return info.chunk;
    if (study == "bands") return info.band;
    if (study == "blocks") return info.block;
    if (study == "threads") return info.threads;
    if (study == "packs") return info.pack;
    // The profiled stages are those of openmp (profile.h).
    if (study == "profile") return info.role == Role::host;
    // Sweeps leave out the reference, which would take minutes.
    if (study != standard_study) return info.role != Role::reference;
    return true;
}

Case case_of(const std::string& short_name, const Point& point, std::pair<int, int> size)
{
    Case made;
    for (const View& view : views_of(short_name, size.first, size.second)) {
        if (view.name == point.change.view) made.scene = view.scene;
    }
    Setting& setting = made.row.setting;
    setting = point.change;
    if (setting.width != 0) {
        made.scene.width = setting.width;
        made.scene.height = setting.height;
    }
    if (setting.iterations != 0) made.scene.iterations = setting.iterations;
    if (setting.detail != 0) made.scene.detail = setting.detail;
    setting.width = made.scene.width;
    setting.height = made.scene.height;
    setting.iterations = made.scene.iterations;
    setting.detail = made.scene.detail;
    setting.power = made.scene.shape[2];
    made.row.fractal = made.scene.fractal->name;
    made.row.point = point.name;
    return made;
}

// Returns the only configuration of a backend without a device, with the reason.
Case missing(const Backend& backend, Listing listing)
{
    Case made;
    made.row.fractal = "all";
    made.row.backend = backend.name();
    made.row.unavailable = std::move(listing.unavailable);
    made.row.failure = std::move(listing.failure);
    return made;
}

// Returns true if a filter in Google Benchmark's syntax selects the name.
bool chosen(const std::string& filter, const std::string& name)
{
    if (filter.empty() || filter == "all") return true;
    const bool others = filter.front() == '-';
    try {
        return std::regex_search(name, std::regex(others ? filter.substr(1) : filter, std::regex::extended)) != others;
    } catch (const std::regex_error&) {
        throw InputError(fmt::format("--benchmark_filter: '{}' given, expected a regular expression", filter));
    }
}

}  // namespace

std::span<const Study> studies() { return all_studies; }

const Study& study_named(std::string_view name)
{
    std::string known;
    for (const Study& study : all_studies) {
        if (study.name == name) return study;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", study.name);
    }
    throw InputError(fmt::format("--study: '{}' given, expected one of {}", name, known));
}

std::vector<std::string> fractals_of(std::string_view option)
{
    if (option != "all") return {std::string(fractal_named(option).short_name)};
    std::vector<std::string> in_default_study;
    for (const Fractal& fractal : fractals()) {
        if (fractal.in_default_study) in_default_study.emplace_back(fractal.short_name);
    }
    return in_default_study;
}

std::vector<Precision> precisions_of(const Options& options)
{
    if (options.precision == "float") return {Precision::f32};
    if (options.precision == "double") return {Precision::f64};
    return {Precision::f64, Precision::f32};
}

std::vector<Mode> modes_of(const Options& options)
{
    const std::string& mode = options.mode;
    if (mode == "fast") return {Mode::fast};
    // The ablation disables optimisations, some of which, such as relaxation, exist in fast mode only.
    if (mode.empty() && options.study == "ablation") return {Mode::fast};
    if (mode == "exact" || (mode.empty() && !study_named(options.study).varies.empty())) return {Mode::exact};
    return {Mode::exact, Mode::fast};
}

std::pair<int, int> size_of(const Options& options)
{
    if (options.size.empty()) {
        if (options.study == "bands") return {1920, 1080};  // large enough for several bands
        const int side = options.study == "frames" ? frames_side : usual_side;
        return {side, side};
    }
    return size_option(options.size);
}

std::string platform_of(const Device& device) { return device.is_gpu ? device.name : host_cpu().platform(); }

bool names_backend(std::string_view asked, std::string_view backend)
{
    if (asked == "all") return true;
    for (const auto name : std::views::split(asked, ',')) {
        if (std::string_view(name.begin(), name.end()) == backend) return true;
    }
    return false;
}

void check_backends(const Registry& registry, std::string_view asked)
{
    for (const auto part : std::views::split(asked, ',')) {
        const std::string_view name(part.begin(), part.end());
        if (asked == "all" || registry.find(name) != nullptr) continue;
        throw InputError(
            fmt::format("--backend: '{}' given, expected all, or names of backends with commas between them", name));
    }
    if (asked.empty())
        throw InputError("--backend: '' given, expected all, or names of backends with commas between them");
}

std::vector<Case> cases_of(const Registry& registry, const Options& options)
{
    std::vector<Case> cases;
    const auto size = size_of(options);
    check_backends(registry, options.backend);
    for (const auto& backend : registry.backends()) {
        const BackendInfo info = backend->info();
        // Include the baselines even if --backend does not name them, as speed-ups are computed from them.
        const bool baselines = options.baselines && options.study == standard_study && info.role != Role::none &&
                               info.role != Role::accelerator;
        const bool all = options.backend == "all" && (options.baselines || info.role != Role::reference);
        const bool asked = all || names_backend(options.backend, backend->name());
        if ((!asked && !baselines) || !takes_part(options.study, info)) continue;
        Listing listing = listing_of(*backend);
        if (listing.devices.empty()) {
            if (asked) cases.push_back(missing(*backend, std::move(listing)));
            continue;
        }
        const std::vector<Device>& devices = listing.devices;
        for (const std::string& short_name : fractals_of(options.fractal)) {
            for (const Point& point : points_for(options, short_name, info)) {
                for (const Precision precision : precisions_of(options)) {
                    for (const Mode mode : modes_of(options)) {
                        if (!asked && !is_baseline(info, point, precision, mode)) continue;
                        for (int device = 0; device < static_cast<int>(devices.size()); ++device) {
                            Case made = case_of(short_name, point, size);
                            const Setting& setting = made.row.setting;
                            made.options = {.device = device,
                                            .precision = precision,
                                            .mode = mode,
                                            .threads = setting.threads,
                                            .pack = setting.pack,
                                            .chunk = setting.chunk,
                                            .band = setting.band,
                                            .block = setting.block,
                                            .counts = false,
                                            .techniques = techniques_without(setting.without)};
                            made.backend = backend.get();
                            const Device& described = devices[static_cast<std::size_t>(device)];
                            made.row.precision = precision;
                            made.row.mode = mode;
                            made.row.backend = backend->name();
                            made.row.device = device;
                            made.row.device_name = described.name;
                            made.row.vendor = described.vendor;
                            made.row.driver = described.driver;
                            made.row.is_gpu = described.is_gpu;
                            made.row.platform = platform_of(described);
                            if (chosen(options.filter, made.row.name())) cases.push_back(std::move(made));
                        }
                    }
                }
            }
        }
    }
    // Sort into the order of the table: all backends for one picture together, and unavailable backends at the end.
    std::ranges::stable_sort(cases, {}, [](const Case& one) {
        const auto fractal = one.backend == nullptr ? fractals().data() + fractals().size() : one.scene.fractal;
        return std::tuple(fractal - fractals().data(), one.row.precision, one.row.mode);
    });
    return cases;
}

}  // namespace mandelmarch::bench
