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

// Returns the sweep values of the study. In the standard study, the backend with the role host also gets the scalar
// kernel as a baseline: a speed-up over it cannot come from another program or from more threads.
std::vector<Point> points_of(const Options& options, const Study& study, const Fractal& fractal,
                             const BackendInfo& info)
{
    if (study.points) return study.points(fractal);
    std::vector<Point> points{{"", [](Setting&) {}}};
    if (options.baselines && study.name == standard_study && info.role == Role::host && info.simd_width) {
        points.push_back({"1", [](Setting& setting) { setting.simd_width = 1; }});
    }
    return points;
}

// Returns true for the baselines of the standard study, which are measured even if --backend does not name them.
bool is_baseline(const BackendInfo& info, const Setting& setting, Precision precision, Mode mode)
{
    if (info.role == Role::reference) return precision == Precision::f64 && mode == Mode::exact;
    return info.role == Role::host && setting.simd_width == 1;
}

Case case_of(const std::string& short_name, const Study& study, const Point& point, std::pair<int, int> size)
{
    Case made;
    Setting& setting = made.row.setting;
    point.set(setting);
    for (const View& view : views_of(short_name, size.first, size.second)) {
        if (view.name == setting.view) made.scene = view.scene;
    }
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
    if (!point.value.empty()) {
        made.row.sweep_value = fmt::format("{}={}", study.axis.empty() ? "simd-width" : study.axis, point.value);
    }
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
    if (options.mode.empty()) return study_named(options.study).modes;
    if (options.mode == "exact") return {Mode::exact};
    if (options.mode == "fast") return {Mode::fast};
    return {Mode::exact, Mode::fast};
}

std::pair<int, int> size_of(const Options& options)
{
    const Study& study = study_named(options.study);
    return options.size.empty() ? std::pair(study.width, study.height) : size_option(options.size);
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
    const Study& study = study_named(options.study);
    const auto size = size_of(options);
    check_backends(registry, options.backend);
    for (const auto& backend : registry.backends()) {
        const BackendInfo info = backend->info();
        // Include the baselines even if --backend does not name them, as speed-ups are computed from them.
        const bool baselines = options.baselines && options.study == standard_study && info.role != Role::none &&
                               info.role != Role::accelerator;
        const bool all = options.backend == "all" && (options.baselines || info.role != Role::reference);
        const bool asked = all || names_backend(options.backend, backend->name());
        if ((!asked && !baselines) || !study.measures(info)) continue;
        Listing listing = listing_of(*backend);
        if (listing.devices.empty()) {
            if (asked) cases.push_back(missing(*backend, std::move(listing)));
            continue;
        }
        const std::vector<Device>& devices = listing.devices;
        for (const std::string& short_name : fractals_of(options.fractal)) {
            for (const Point& point : points_of(options, study, fractal_named(short_name), info)) {
                for (const Precision precision : precisions_of(options)) {
                    for (const Mode mode : modes_of(options)) {
                        for (int device = 0; device < static_cast<int>(devices.size()); ++device) {
                            Case made = case_of(short_name, study, point, size);
                            const Setting& setting = made.row.setting;
                            if (!asked && !is_baseline(info, setting, precision, mode)) continue;
                            made.options = {.device = device,
                                            .precision = precision,
                                            .mode = mode,
                                            .threads = setting.threads,
                                            .simd_width = setting.simd_width,
                                            .chunk = setting.chunk,
                                            .band = setting.band,
                                            .block_size = setting.block_size,
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
