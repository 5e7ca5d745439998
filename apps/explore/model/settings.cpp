// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/settings.h"

#include <algorithm>
#include <filesystem>

#include "core/text/environment.h"
#include "core/os/input_file.h"
#include "core/text/json.h"
#include "core/os/output_file.h"
#include "core/image/image.h"

namespace mandelmarch::explore {

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
