// SPDX-License-Identifier: Apache-2.0
#include "apps/scene_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/render/kernel_scene.h"
#include "core/render/stepping.h"
#include "core/scene/formula.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch {
namespace {

using Json = nlohmann::ordered_json;

FractalInputs<Formula> named_inputs()
{
    return {.shape = {Formula::input("shape[0]"), Formula::input("shape[1]"), Formula::input("shape[2]")},
            .escape = Formula::input("escape"),
            .iterations = Formula::input("iterations"),
            .largest = Formula::input("largest"),
            .conservative = Formula::input("conservative")};
}

// Returns a shape parameter with its slider in the report's viewer. The slider is null if the parameter is unused.
Json of(const ParameterInfo& meaning, double official)
{
    Json slider;
    if (meaning.slider || meaning.name != ignored_number.name) {
        const auto [low, high, step] = slider_of(meaning, official);
        slider = {low, high, step};
    }
    return {{"name", meaning.name}, {"low", meaning.low}, {"high", meaning.high}, {"slider", slider}};
}

template <class Triple>
Json of(const Triple& a)
{
    return {a.x, a.y, a.z};
}

Json parameters_of(const Scene& s)
{
    return {{"eye", of(s.eye)},         {"target", of(s.target)},      {"up", of(s.up)},
            {"field", s.field_of_view}, {"size", {s.width, s.height}}, {"detail", s.detail},
            {"shape", s.shape},         {"iterations", s.iterations},  {"escape", s.escape},
            {"colouring", s.colouring}, {"brightness", s.brightness}};
}

Json of(const Fractal& fractal)
{
    const FractalInputs<Formula> inputs = named_inputs();
    const FractalConstants<Formula> constants = fractal.constants.text(inputs);
    Json values = Json::array();
    for (const Formula& value : constants.values) values.push_back(value.text());
    const Scene official = official_scene(fractal);
    Json shape = Json::array();
    for (std::size_t i = 0; i < fractal.shape.size(); ++i) {
        shape.push_back(of(fractal.shape.at(i), official.shape.at(i)));
    }
    return {{"name", fractal.name},
            {"short_name", fractal.short_name},
            {"official", parameters_of(official)},
            {"shape", shape},
            {"escape", of(fractal.escape, official.escape)},
            {"constants", values},
            {"whole", constants.whole.text()},
            {"step_factor", fractal.fast.step_factor.text(inputs).text()},
            {"root_share", fractal.fast.root_share}};
}

// Returns the kernel's numbers of the look of each colouring type. They are 0 for colouring types 0 and 1.
Json built_in_looks()
{
    Json looks = Json::array();
    for (int type = 0; type < colouring_types; ++type) {
        Scene scene = official_scene(fractals().front());
        scene.colouring = type;
        looks.push_back(kernel_scene<layout_f64::Scene>(scene, Mode::fast).look);
    }
    return looks;
}

template <class Layout>
Json json_of(const Layout& k)
{
    // JSON cannot represent infinity, so a string stands for it.
    const auto finite = [](double value) { return std::isfinite(value) ? Json(value) : Json("Infinity"); };
    return {{"width", k.width},
            {"height", k.height},
            {"max_iterations", k.max_iterations},
            {"max_steps", k.max_steps},
            {"fractal_whole", k.fractal_whole},
            {"colouring", k.colouring},
            {"canonical", k.canonical},
            {"differences", k.differences},
            {"tolerance", k.tolerance},
            {"step_factor", k.step_factor},
            {"end", k.end},
            {"miss", finite(k.miss)},
            {"brightness", k.brightness},
            {"difference_step", k.difference_step},
            {"hull", k.hull},
            {"subtile_hull", k.subtile_hull},
            {"spacing", k.spacing},
            {"relaxation", k.relaxation},
            {"root_share", k.root_share},
            {"longitude", k.longitude},
            {"longitudes", k.longitudes},
            {"latitude", k.latitude},
            {"latitudes", k.latitudes},
            {"fractal", k.fractal},
            {"look", k.look},
            {"eye", of(k.eye)},
            {"forward", of(k.forward)},
            {"across", of(k.across)},
            {"upward", of(k.upward)},
            {"sun", of(k.sun)},
            {"sky_west", of(k.sky_west)},
            {"sky_up", of(k.sky_up)},
            {"sky_north", of(k.sky_north)},
            {"grain", of(k.grain)}};
}

}  // namespace

ParameterInfo::Slider slider_of(const ParameterInfo& meaning, double official)
{
    if (meaning.slider) return *meaning.slider;
    const double room = std::max(1.0, 0.5 * std::abs(official));
    return {std::max(meaning.low, official - room), std::min(meaning.high, official + room), room / 100};
}

std::string fractals_json()
{
    Json rows = Json::array();
    for (const Fractal& fractal : fractals()) rows.push_back(of(fractal));
    const Json json{{"scene",
                     {{"end", farthest_sample},
                      {"max_steps", max_steps},
                      {"degrees_per_field", degrees_per_field},
                      {"largest", float_range},
                      {"plain_step_factor", plain_step_factor},
                      {"longest_relaxed", longest_relaxed},
                      {"colouring_types", colouring_names},
                      {"looks", built_in_looks()},
                      {"max_iterations", max_iterations},
                      {"max_field", max_field_of_view},
                      {"sun", of(Scene{}.sky.sun)}}},
                    {"fractals", rows}};
    return json.dump(2) + "\n";
}

std::string fractals_text()
{
    std::string text;
    for (const Fractal& fractal : fractals()) {
        text += fmt::format("{} ({})\n", fractal.name, fractal.short_name);
        const auto line = [&](std::string_view where, const ParameterInfo& meaning) {
            if (meaning.name == ignored_number.name) return;
            text += fmt::format("  {:<24} {}, {}{} to {}\n", where, meaning.name, meaning.open_low ? "over " : "",
                                meaning.low, meaning.high);
        };
        for (std::size_t i = 0; i < fractal.shape.size(); ++i) {
            line(fmt::format("line 7, number {}", i + 1), fractal.shape.at(i));
        }
        line("line 8, number 2", fractal.escape);
    }
    return text;
}

std::string scene_json(const Scene& scene, const RendererOptions& options)
{
    Techniques techniques = options.techniques;
    techniques.tail = false;
    const Json json = options.precision == Precision::f32
                          ? json_of(kernel_scene<layout_f32::Scene>(scene, options.mode, techniques))
                          : json_of(kernel_scene<layout_f64::Scene>(scene, options.mode, techniques));
    return json.dump(2) + "\n";
}

}  // namespace mandelmarch
