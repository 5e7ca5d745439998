// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/cli/options.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
bool Options::selects(std::string_view backend) const
{
    return backends.empty() || std::ranges::find(backends, backend) != backends.end();
}

std::vector<std::string> parse_backends(Registry& registry, std::string_view text)
{
    if (text == "all") return {};
    const std::vector<std::string_view> parts = split(text, ',');
    std::vector<std::string> names(parts.begin(), parts.end());
    for (const std::string& name : names) {
        if (registry.open(name) != nullptr) continue;
        throw InputError(fmt::format(
            "--backend: '{}' given, expected all, or names of backends and program:PROGRAM with commas between them",
            name));
    }
    return names;
}

void add_fractal(CLI::App& app, std::vector<const Fractal*>& fractals, const std::string& about)
{
    const auto set = [&fractals](const std::string& text) {
        if (text != "all") fractals = {&fractal_named(text)};
    };
    app.add_option_function<std::string>("--fractal", set, about)->default_str("all");
}

void add_devices(CLI::App& app, Registry& registry, Options& options)
{
    app.add_option_function<std::string>(
           "--backend",
           [&registry, &options](const std::string& text) { options.backends = parse_backends(registry, text); },
           "backend to measure: all, or a list such as openmp,reference,program:./mine")
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
    add_fractal(app, options.fractals,
                fmt::format("fractal to measure: all ({}), or one name",
                            fmt::join(mapped(default_fractals(), &Fractal::short_name), " and ")));
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
           fmt::format("what to vary: {}", fmt::join(mapped(studies(), &Study::name), ", ")))
        ->default_str(std::string(options.study->name));
    app.add_option("--filter", options.filter,
                   "measure only configurations whose names have one of these parts, separated by commas; a part with "
                   "*, ? or [] must match the whole name; with - in front, only the others");
}

}  // namespace mandelmarch::bench
