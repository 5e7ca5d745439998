// SPDX-License-Identifier: Apache-2.0
#include "bench/study/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <tuple>

#include "bench/study/views.h"
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

Case case_of(const Fractal& fractal, const Study& study, const Point& point, std::pair<int, int> size)
{
    Case made;
    Setting& setting = made.row.setting;
    point.set(setting);
    for (const View& view : views_of(fractal.short_name, size.first, size.second)) {
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
        throw InputError(fmt::format("--filter: '{}' given, expected a regular expression", filter));
    }
}

}  // namespace

std::string platform_of(const Device& device) { return device.is_gpu ? device.name : host_cpu().platform(); }

std::vector<Case> cases_of(const Registry& registry, const Options& options)
{
    std::vector<Case> cases;
    const Study& study = *options.study;
    for (const auto& backend : registry.backends()) {
        const BackendInfo info = backend->info();
        // Include the baselines even if --backend does not name them, as speed-ups are computed from them.
        const bool baselines = options.baselines && study.name == standard_study && info.role != Role::none &&
                               info.role != Role::accelerator;
        const bool unasked = options.backends.empty() && !options.baselines && info.role == Role::reference;
        const bool asked = !unasked && options.selects(backend->name());
        if ((!asked && !baselines) || !study.measures(info)) continue;
        Listing listing = listing_of(*backend);
        if (listing.devices.empty()) {
            if (asked) cases.push_back(missing(*backend, std::move(listing)));
            continue;
        }
        const std::vector<Device>& devices = listing.devices;
        for (const Fractal* fractal : options.fractals) {
            for (const Point& point : points_of(options, study, *fractal, info)) {
                for (const Precision precision : options.precisions) {
                    for (const Mode mode : options.selected_modes()) {
                        for (int device = 0; device < static_cast<int>(devices.size()); ++device) {
                            Case made = case_of(*fractal, study, point, options.picture_size());
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
