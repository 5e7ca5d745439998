// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "bench/measure/views.h"
#include "core/os/cpu.h"
#include "core/scene/parameter_file.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

// Returns an axis with one point for each element of a list. The axis adds nothing to the sweep value.
template <class List, class Set>
Axis over(const List& list, Set set)
{
    std::vector<Point> points;
    points.reserve(list.size());
    for (const auto& element : list) points.push_back({"", [element, set](Case& one) { set(one, element); }});
    return {"", [points](const Case&) { return points; }};
}

// Returns the product of the axes; the last one varies fastest.
std::vector<Case> crossed(const std::vector<Axis>& axes)
{
    std::vector<Case> cases(1);
    for (const Axis& axis : axes) {
        std::vector<Case> product;
        for (const Case& so_far : cases) {
            for (const Point& point : axis.points(so_far)) {
                Case& one = product.emplace_back(so_far);
                point.set(one);
                if (point.value.empty()) continue;
                std::string& text = one.row.sweep_value;
                text += fmt::format("{}{}={}", text.empty() ? "" : ",", axis.name, point.value);
            }
        }
        cases = std::move(product);
    }
    return cases;
}

// Returns the points of the axis simd-width: the backend's default and, for the host, also the scalar kernel, a
// baseline. It runs the same kernel source on the same threads. Therefore the host's speed-up over it does not come
// from another program or from more threads.
std::vector<Point> kernels(const Case& one)
{
    std::vector<Point> points{{"", [](Case&) {}}};
    const BackendInfo info = one.backend->info();
    if (info.role == Role::host && info.simd_width) {
        points.push_back({"1", [](Case& scalar) { scalar.row.setting.simd_width = 1; }});
    }
    return points;
}

// Returns true for the baselines, which are measured even if --backend does not name them.
bool is_baseline(const Case& one)
{
    const Row& row = one.row;
    const Role role = one.backend->info().role;
    if (role == Role::reference) return row.precision == Precision::f64 && row.mode == Mode::exact;
    return role == Role::host && row.setting.simd_width == 1;
}

void set_device(Case& one, int index, const Device& device)
{
    Row& row = one.row;
    row.device = index;
    row.device_name = device.name;
    row.vendor = device.vendor;
    row.driver = device.driver;
    row.is_gpu = device.is_gpu;
    row.platform = platform_of(device);
}

// Sets the scene and the options that the row describes, and the values of the setting that follow from the scene.
void realise(Case& one, const Options& options)
{
    Row& row = one.row;
    Setting& setting = row.setting;
    Scene& scene = one.scene;
    const auto [width, height] = options.picture_size();
    for (const View& view : views_of(scene.fractal->short_name, width, height)) {
        if (view.name == setting.view) scene = view.scene;
    }
    if (!options.scene.empty()) {
        scene = read_parameters(options.scene, *scene.fractal).scene;
        if (options.size) std::tie(scene.width, scene.height) = *options.size;
        setting.view = options.scene;
    }
    if (setting.width != 0) {
        scene.width = setting.width;
        scene.height = setting.height;
    }
    if (setting.iterations != 0) scene.iterations = setting.iterations;
    if (setting.detail != 0) scene.detail = setting.detail;
    setting.width = scene.width;
    setting.height = scene.height;
    setting.iterations = scene.iterations;
    setting.detail = scene.detail;
    setting.power = scene.shape[2];
    one.options = {.device = row.device,
                   .precision = row.precision,
                   .mode = row.mode,
                   .threads = setting.threads,
                   .simd_width = setting.simd_width,
                   .chunk = setting.chunk,
                   .band = setting.band,
                   .block_size = setting.block_size,
                   .resident_warps = setting.resident_warps,
                   .counts = false,
                   .techniques = techniques_without(setting.without)};
}

// Returns the only configuration of a backend without a device. It holds the reason why there is no device.
Case missing(const Backend& backend, Listing listing)
{
    Case made;
    made.row.fractal = "all";
    made.row.backend = backend.name();
    made.row.unavailable = std::move(listing.unavailable);
    made.row.failure = std::move(listing.failure);
    return made;
}

// Returns true if the pattern selects the name: a pattern with *, ? or [ must match the whole name, any other must
// occur in it.
bool is_selected(const std::string& name, const std::string& pattern)
{
    if (pattern.find_first_of("*?[") == std::string::npos) return name.find(pattern) != std::string::npos;
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

// Returns a function that tests whether the filter (Options::filter) selects a name.
std::function<bool(const std::string& name)> selection(const std::string& filter)
{
    if (filter.empty()) return [](const std::string&) { return true; };
    const bool others = filter.front() == '-';
    const std::vector<std::string_view> parts = split(std::string_view(filter).substr(others ? 1 : 0), ',');
    const std::vector<std::string> patterns(parts.begin(), parts.end());
    if (std::ranges::count(patterns, "") != 0) {
        throw InputError(fmt::format("--filter: '{}' given, expected texts with commas between them", filter));
    }
    return [=](const std::string& name) {
        return std::ranges::any_of(patterns, [&](const std::string& one) { return is_selected(name, one); }) != others;
    };
}

}  // namespace

std::string platform_of(const Device& device) { return device.is_gpu ? device.name : host_cpu().platform(); }

std::vector<Case> cases_of(const Registry& registry, const Options& options)
{
    const Study& study = *options.study;
    if (!options.scene.empty() && options.fractals.size() != 1) {
        throw InputError("--scene without --fractal given, expected the fractal that the file is of");
    }
    if (!options.scene.empty() && std::ranges::count(study.axes, "scene", &Axis::name) > 0) {
        throw InputError(
            fmt::format("--scene with --study {} given, whose scenes differ, expected one of them", study.name));
    }
    const bool baselines = study.baselines;
    const auto selected = [&](const Backend& backend) { return options.selects(backend.name()); };
    std::vector<const Backend*> backends;
    std::map<const Backend*, std::vector<Device>> devices;
    std::vector<Case> without_device;
    for (const auto& backend : registry.backends()) {
        const BackendInfo info = backend->info();
        // Include the baselines even if --backend does not name them, because speed-ups are computed from them.
        const bool baseline = baselines && (info.role == Role::reference || info.role == Role::host);
        if ((!selected(*backend) && !baseline) || !study.measures(info)) continue;
        Listing listing = listing_of(*backend);
        if (!listing.devices.empty()) {
            backends.push_back(backend.get());
            devices[backend.get()] = std::move(listing.devices);
        } else if (selected(*backend)) {
            without_device.push_back(missing(*backend, std::move(listing)));
        }
    }
    std::vector<Axis> axes{over(backends,
                                [](Case& one, const Backend* backend) {
                                    one.backend = backend;
                                    one.row.backend = backend->name();
                                }),
                           over(options.fractals, [](Case& one, const Fractal* fractal) {
                               one.scene.fractal = fractal;
                               one.row.fractal = fractal->name;
                           })};
    axes.insert(axes.end(), study.axes.begin(), study.axes.end());
    if (baselines) axes.push_back({"simd-width", kernels});
    axes.push_back(over(options.precisions, [](Case& one, Precision precision) { one.row.precision = precision; }));
    axes.push_back(over(options.selected_modes(), [](Case& one, Mode mode) { one.row.mode = mode; }));
    axes.push_back({"", [&devices](const Case& one) {
                        std::vector<Point> points;
                        for (const Device& device : devices.at(one.backend)) {
                            const int index = static_cast<int>(points.size());
                            points.push_back({"", [=](Case& made) { set_device(made, index, device); }});
                        }
                        return points;
                    }});
    std::vector<Case> cases = crossed(axes);
    const auto chosen = selection(options.filter);
    std::erase_if(cases, [&](const Case& one) {
        const bool again =
            one.row.precision != options.precisions.front() || one.row.mode != options.selected_modes().front();
        return (one.backend->info().foreign && (again || !one.row.setting.without.empty())) ||
               !(selected(*one.backend) || is_baseline(one)) || !study.keeps(one) || !chosen(one.row.name());
    });
    for (Case& one : cases) realise(one, options);
    cases.insert(cases.end(), without_device.begin(), without_device.end());
    // Sort the configurations in the order of the table: those of the same picture, or of the same fractal's ladder,
    // stand together. Backends without a device come last.
    std::ranges::stable_sort(cases, {}, [&](const Case& one) {
        const auto fractal = one.backend == nullptr ? fractals().data() + fractals().size() : one.scene.fractal;
        const auto index = fractal - fractals().data();
        if (study.name == ladder_study) return std::tuple(index, Precision{}, Mode{});
        return std::tuple(index, one.row.precision, one.row.mode);
    });
    return cases;
}

}  // namespace mandelmarch::bench
