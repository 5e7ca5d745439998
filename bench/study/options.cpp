// SPDX-License-Identifier: Apache-2.0
#include "bench/study/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <ranges>

#include "cli/option_values.h"
#include "core/base/error.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {
namespace {

// Returns the names of a list's elements, separated by commas; `otherwise` for a list of all.
template <class List, class Name>
std::string names_of(const List& list, const Name& name, bool all, const char* otherwise = "all")
{
    std::string text;
    for (const auto& element : list) text += fmt::format("{}{}", text.empty() ? "" : ",", name(element));
    return all ? otherwise : text;
}

}  // namespace

std::vector<const Fractal*> default_fractals()
{
    std::vector<const Fractal*> studied;
    for (const Fractal& fractal : fractals()) {
        if (fractal.in_default_study) studied.push_back(&fractal);
    }
    return studied;
}

bool Options::selects(std::string_view backend) const
{
    return backends.empty() || std::ranges::find(backends, backend) != backends.end();
}

std::vector<std::string> parse_backends(const Registry& registry, std::string_view text)
{
    std::vector<std::string> names;
    if (text == "all") return names;
    for (const auto part : std::views::split(text, ',')) names.emplace_back(part.begin(), part.end());
    if (names.empty()) names.emplace_back();
    for (const std::string& name : names) {
        if (registry.find(name) != nullptr) continue;
        throw InputError(
            fmt::format("--backend: '{}' given, expected all, or names of backends with commas between them", name));
    }
    return names;
}

std::vector<const Fractal*> parse_fractals(std::string_view text, std::vector<const Fractal*> all)
{
    return text == "all" ? std::move(all) : std::vector{&fractal_named(text)};
}

void add_selection(CLI::App& app, const Registry& registry, Options& options)
{
    app.add_option_function<std::string>(
           "--backend", [&](const std::string& text) { options.backends = parse_backends(registry, text); },
           "backend to measure: all, or a list such as openmp,opencl")
        ->default_str("all");
    app.add_option_function<std::string>(
           "--fractal", [&](const std::string& text) { options.fractals = parse_fractals(text, default_fractals()); },
           fmt::format(
               "fractal to measure: all ({}), or one name",
               fmt::join(default_fractals() | std::views::transform([](const Fractal* f) { return f->short_name; }),
                         " and ")))
        ->default_str("all");
    app.add_option_function<std::string>(
           "--precision",
           [&](const std::string& text) {
               if (text != "all") options.precisions = {text == "float" ? Precision::f32 : Precision::f64};
           },
           "precision to measure: all, float or double")
        ->check(CLI::IsMember({"all", "float", "double"}))
        ->default_str("all");
    app.add_option_function<std::string>(
           "--mode",
           [&](const std::string& text) {
               options.modes = {Mode::exact, Mode::fast};
               if (text != "all") options.modes = {text == "fast" ? Mode::fast : Mode::exact};
           },
           "mode to measure: all, exact or fast (default: all; in sweeps exact)")
        ->check(CLI::IsMember({"all", "exact", "fast"}));
    app.add_option_function<std::string>(
        "--size", [&](const std::string& text) { options.size = size_option(text); },
        "picture size, WxH in pixels (default 540x540)");
    app.add_option_function<std::string>(
           "--study", [&](const std::string& text) { options.study = &study_named(text); },
           fmt::format("what to vary: {}", fmt::join(studies() | std::views::transform(&Study::name), ", ")))
        ->default_str(std::string(options.study->name));
    app.add_option("--filter,--benchmark_filter", options.filter,
                   "regular expression: measure only rows whose name contains it; with - in front, all others");
}

// Programs of older builds must understand these words.
std::vector<std::string> words_of(const Options& o)
{
    std::vector<std::string> words{
        "--backend",
        names_of(o.backends, std::identity(), o.backends.empty()),
        "--fractal",
        names_of(
            o.fractals, [](const Fractal* f) { return f->short_name; }, o.fractals == default_fractals()),
        "--precision",
        names_of(
            o.precisions, [](Precision p) { return name_of(p); }, o.precisions.size() > 1),
        "--study",
        std::string(o.study->name),
        "--seed",
        std::to_string(o.seed)};
    if (!o.modes.empty()) {
        words.insert(words.end(), {"--mode", names_of(
                                                 o.modes, [](Mode m) { return name_of(m); }, o.modes.size() > 1)});
    }
    if (o.size) words.insert(words.end(), {"--size", fmt::format("{}x{}", o.size->first, o.size->second)});
    if (!o.filter.empty()) words.push_back("--benchmark_filter=" + o.filter);
    return words;
}

}  // namespace mandelmarch::bench
