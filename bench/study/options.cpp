// SPDX-License-Identifier: Apache-2.0
#include "bench/study/options.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/option_values.h"
#include "bench/base/table.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

std::string_view name_of_fractal(const Fractal* fractal) { return fractal->short_name; }

}  // namespace

bool Options::selects(std::string_view backend) const
{
    return backends.empty() || std::ranges::find(backends, backend) != backends.end();
}

std::vector<std::string> parts_of(std::string_view text)
{
    std::vector<std::string> parts;
    for (std::size_t at = 0; at <= text.size();) {
        const auto comma = std::min(text.find(',', at), text.size());
        parts.emplace_back(text.substr(at, comma - at));
        at = comma + 1;
    }
    return parts;
}

std::vector<std::string> parse_backends(Registry& registry, std::string_view text)
{
    if (text == "all") return {};
    std::vector<std::string> names = parts_of(text);
    for (const std::string& name : names) {
        if (registry.open(name) != nullptr) continue;
        throw InputError(fmt::format(
            "--backend: '{}' given, expected all, or names of backends and program:PROGRAM with commas between them",
            name));
    }
    return names;
}

std::vector<const Fractal*> parse_fractals(std::string_view text, std::vector<const Fractal*> all)
{
    return text == "all" ? std::move(all) : std::vector{&fractal_named(text)};
}

void add_devices(CLI::App& app, Registry& registry, Options& options)
{
    app.add_option_function<std::string>(
           "--backend",
           [&registry, &options](const std::string& text) { options.backends = parse_backends(registry, text); },
           "backend to measure: all, or a list such as openmp,opencl,program:./mine")
        ->default_str("all");
    app.add_option_function<std::string>(
           "--precision",
           [&options](const std::string& text) {
               if (text != "all") options.precisions = {text == "float" ? Precision::f32 : Precision::f64};
           },
           "precision to measure: all, float or double")
        ->check(CLI::IsMember({"all", "float", "double"}))
        ->default_str("all");
}

void add_selection(CLI::App& app, Registry& registry, Options& options)
{
    add_devices(app, registry, options);
    app.add_option_function<std::string>(
           "--fractal", [&](const std::string& text) { options.fractals = parse_fractals(text, default_fractals()); },
           fmt::format("fractal to measure: all ({}), or one name",
                       joined(default_fractals(), " and ", name_of_fractal)))
        ->default_str("all");
    app.add_option_function<std::string>(
           "--mode",
           [&](const std::string& text) {
               options.modes = {Mode::exact, Mode::fast};
               if (text != "all") options.modes = {text == "fast" ? Mode::fast : Mode::exact};
           },
           "mode to measure: all, exact or fast (default: depends on the study; the study standard uses both)")
        ->check(CLI::IsMember({"all", "exact", "fast"}));
    app.add_option("--scene", options.scene,
                   "parameter file to render, for one --fractal (default: the study's scenes)");
    app.add_option_function<std::string>(
        "--size", [&](const std::string& text) { options.size = size_option(text); },
        "picture size, WxH in pixels (default: the study's, 540x540 in most)");
    app.add_option_function<std::string>(
           "--study", [&](const std::string& text) { options.study = &study_named(text); },
           "what to vary: " + joined(studies(), ", ", &Study::name))
        ->default_str(std::string(options.study->name));
    app.add_option("--filter", options.filter,
                   "measure only configurations whose names have one of these parts, separated by commas; a part with "
                   "*, ? or [] must match the whole name; with - in front, only the others");
}

}  // namespace mandelmarch::bench
