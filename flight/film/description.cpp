// SPDX-License-Identifier: Apache-2.0
#include "flight/film/description.h"

#include <fmt/format.h>
#include <sys/auxv.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "core/scene/fractal.h"
#include "core/text/environment.h"
#include "core/text/text.h"
#include "core/text/version.h"
#include "flight/film/segment_store.h"

namespace mandelmarch {
namespace {

Device device_of(const Backend& backend, const RendererOptions& renderer)
{
    const auto devices = backend.devices();
    const auto number = static_cast<std::size_t>(renderer.device);
    return number < devices.size() ? devices[number] : Device{};
}

// Returns the look that replaces the path's: the numbers of a look file or a colouring type; -1: no look does.
nlohmann::ordered_json look_in(const Picture& picture)
{
    if (!picture.look) return -1;
    if (!picture.look->values) return picture.look->colouring;
    return picture.look->values->numbers;
}

// Returns the file of this program; if /proc is missing, the name that it was started by.
const char* program_file()
{
    constexpr const char* linked = "/proc/self/exe";
    return access(linked, F_OK) == 0 ? linked : reinterpret_cast<const char*>(getauxval(AT_EXECFN));
}

}  // namespace

std::string description_of(const Path& path, const Backend& backend, const Picture& picture,
                           const RendererOptions& renderer,
                           const std::vector<std::pair<std::string, std::string>>& more)
{
    const std::string instructions = environment_variable("MANDELMARCH_INSTRUCTIONS");
    const Device device = device_of(backend, renderer);
    nlohmann::ordered_json json{
        {"path", digest(to_text(path))},
        {"frames", path.frames.size()},
        {"every", path.every},
        {"width", picture.width},
        {"height", picture.height},
        {"samples", picture.samples},
        {"look", look_in(picture)},
        {"equirectangular", picture.projection == Projection::equirectangular},
        {"stereo", picture.stereo},
        {"backend", backend.name()},
        {"device", device.name},
        {"driver", device.driver},
        {"instructions", instructions.empty() ? "all of the machine" : instructions},
        {"precision", name_of(renderer.precision)},
        {"mode", name_of(renderer.mode)},
        {"program", digest_of_file(program_file())},
    };
    for (const auto& [name, value] : more) json[name] = value;
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string differences(const std::string& theirs, const std::string& ours)
{
    using Json = nlohmann::ordered_json;
    const Json a = Json::parse(theirs, nullptr, false);
    const Json b = Json::parse(ours, nullptr, false);
    if (!a.is_object() || !b.is_object()) return theirs == ours ? "" : "another format";
    constexpr std::size_t longest = 60;  // bytes of a value
    const auto shown = [](const Json& object, const std::string& key) {
        const auto found = object.find(key);
        if (found == object.end()) return std::string("none");
        const std::string text = found->is_string() ? found->get<std::string>() : found->dump();
        return "'" + printable(text, longest) + "'";
    };
    std::string text;
    for (const auto& [key, value] : b.items()) {
        if (a.contains(key) && a[key] == value) continue;
        text += fmt::format("{}{}: {}, here {}", text.empty() ? "" : "; ", key, shown(a, key), shown(b, key));
    }
    return text.empty() && theirs != ours ? "other keys" : text;
}

std::string summary_of(const Path& path, const Backend& backend, const FilmOptions& options, const FilmStats& report,
                       int processes)
{
    const Device device = device_of(backend, options.renderer);
    nlohmann::ordered_json json{
        {"schema", "mandelmarch-film"},
        {"version", 1},
        {"program", version_line("flythrough")},
        {"fractal", path.scene.fractal->name},
        {"seed", path.seed},
        {"frames", path.frames.size()},
        {"frames_per_second", path.frames_per_second},
        {"width", options.picture.width},
        {"height", options.picture.height},
        {"samples", options.picture.samples},
        {"backend", backend.name()},
        {"device", {{"name", device.name}, {"driver", device.driver}, {"is_gpu", device.is_gpu}}},
        {"precision", name_of(options.renderer.precision)},
        {"mode", name_of(options.renderer.mode)},
        {"threads", backend.info().threads ? options.renderer.threads : 0},
        {"processes", processes},
        {"frames_rendered", report.frames},
        {"seconds", report.seconds},
    };
    json["seconds_per_frame"] = report.frames > 0
                                    ? nlohmann::ordered_json(report.seconds / static_cast<double>(report.frames))
                                    : nlohmann::ordered_json();
    return json.dump(2) + "\n";
}

}  // namespace mandelmarch
