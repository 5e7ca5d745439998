// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <numbers>
#include <vector>

#include "core/os/input_file.h"
#include "core/os/output_file.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/text/environment.h"
#include "core/text/json.h"
#include "flight/path/path.h"
#include "flight/path/places.h"

namespace mandelmarch::explore {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text)
{
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Returns the fractal whose name occurs in the file's text (to_parameters() writes it as a comment) or, failing that,
// in the file's name. Returns `hint` if neither contains a name.
const Fractal& guess(const std::string& text, const std::string& name, const Fractal& hint)
{
    for (const std::string& where : {lower(text), lower(std::filesystem::path(name).filename().string())}) {
        for (const auto name_of : {&Fractal::name, &Fractal::short_name}) {
            for (const Fractal& fractal : fractals()) {
                if (where.find(fractal.*name_of) != std::string::npos) return fractal;
            }
        }
    }
    return hint;
}

}  // namespace

void as_file(Scene& scene)
{
    const Scene plain;
    scene.smooth = plain.smooth;
    scene.centred = plain.centred;
    scene.projection = plain.projection;
    scene.sky = plain.sky;
    scene.limits = plain.limits;
    scene.crop_window = plain.crop_window;
}

std::string view_text(const Scene& scene)
{
    std::string text = to_parameters(scene);
    if (scene.conservative) text = "# drawn with --estimate conservative\n" + text;
    return text;
}

std::string command_of(const Scene& scene, const Setup& setup, const std::string& file)
{
    return fmt::format("bin/render {} --fractal {} --backend {} --device {} --precision {} --mode {}{}", file,
                       scene.fractal->name, setup.backend, setup.device, mandelmarch::name_of(setup.precision),
                       mandelmarch::name_of(setup.mode), scene.conservative ? " --estimate conservative" : "");
}

std::string free_name(const std::string& folder, const std::string& stem)
{
    for (int number = 1;; ++number) {
        std::string name = fmt::format("{}{}{}-{:03}", folder, folder.empty() ? "" : "/", stem, number);
        const std::array endings{".dat", ".png", ".json", ".mp4"};
        if (std::ranges::none_of(endings, [&](auto ending) { return fs::exists(fs::symlink_status(name + ending)); }))
            return name;
    }
}

Scene view_of_text(const std::string& text, const std::string& name, const Fractal& hint)
{
    Scene scene = parse_parameters(text, name, guess(text, name, hint)).scene;
    scene.conservative = text.starts_with("# drawn with --estimate conservative");
    return scene;
}

std::size_t append_place(const std::string& file, const Scene& scene)
{
    std::string text = std::string(places_header) + "\n";
    if (std::filesystem::exists(file)) {
        text = text_of_file(file, "places file");
        if (!text.ends_with('\n')) text += '\n';
    }
    Place place;
    place.eye = scene.eye;
    place.target = scene.target;
    place.lens = scene.field_of_view;
    const Tilt tilt = tilt_of({scene.eye, scene.target, scene.up, 1, {}}, *scene.fractal);
    if (tilt.horizon > 0.01) place.roll = tilt.angle * 180 / std::numbers::pi;
    const std::string line = place_line(place);
    text += line + "\n";
    const Places places = places_from_text(text, file);
    if (place_line(places.all.back()) != line) {
        throw InputError(fmt::format("{}: columns in another order, expected {}", file, places_header));
    }
    write_file(file, text);
    return places.all.size();
}

Scene read_view(const std::string& file, const Fractal& hint)
{
    return view_of_text(text_of_file(file, "parameter file"), file, hint);
}

std::span<const StartView> start_views()
{
    static const std::vector<StartView> embedded{
#include "start_views.inc"
    };
    return embedded;
}

using Json = nlohmann::ordered_json;

constexpr int most_window_side = 8192;  // pixels; SDL refuses windows that are much larger

std::string settings_file()
{
    const std::string config = environment_variable("XDG_CONFIG_HOME");
    const std::string home = environment_variable("HOME");
    if (!config.empty()) return config + "/mandelmarch/explore.json";
    return home.empty() ? "" : home + "/.config/mandelmarch/explore.json";
}

Settings read_settings(const std::string& file, std::string& said)
{
    Settings settings;
    std::error_code none;
    if (file.empty() || !std::filesystem::exists(file, none)) return settings;
    try {
        const Json json = parse_json<Json>(own_file(file).value_or(""), file);
        Settings read;
        read.width = std::max(json.value("width", read.width), 160);
        read.height = std::max(json.value("height", read.height), 160);
        if (std::max(read.width, read.height) > most_window_side) {
            said = file + ": the window is too large, so the defaults are used";
            return settings;
        }
        read.setup.backend = json.value("backend", read.setup.backend);
        read.setup.device = std::max(0, json.value("device", 0));
        read.setup.precision = json.value("precision", "float") == "double" ? Precision::f64 : Precision::f32;
        read.setup.mode = json.value("mode", "fast") == "exact" ? Mode::exact : Mode::fast;
        read.look = std::clamp(json.value("look", read.look), 0, colouring_types - 1);
        read.speed = std::clamp(json.value("speed", read.speed), 1.0 / 16, 16.0);
        read.scale = std::clamp(json.value("scale", read.scale), 0.5, 4.0);
        read.collides = json.value("collides", read.collides);
        read.panel = json.value("panel", read.panel);
        read.statistics = json.value("statistics", read.statistics);
        return read;
    } catch (const std::exception&) {
        said = file + ": not a settings file, so the defaults are used";
        return settings;
    }
}

void write_settings(const std::string& file, const Settings& settings)
{
    if (file.empty() || OutputFile::is_stream(file)) return;
    std::error_code ignored;
    std::filesystem::create_directories(std::filesystem::path(file).parent_path(), ignored);
    const Json json{{"width", settings.width},
                    {"height", settings.height},
                    {"backend", settings.setup.backend},
                    {"device", settings.setup.device},
                    {"precision", mandelmarch::name_of(settings.setup.precision)},
                    {"mode", mandelmarch::name_of(settings.setup.mode)},
                    {"look", settings.look},
                    {"speed", settings.speed},
                    {"scale", settings.scale},
                    {"collides", settings.collides},
                    {"panel", settings.panel},
                    {"statistics", settings.statistics}};
    write_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace mandelmarch::explore
