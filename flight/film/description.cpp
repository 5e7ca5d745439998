// SPDX-License-Identifier: Apache-2.0
#include "flight/film/description.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "flight/film/note.h"

namespace mandelmarch {

std::string description_of(const Path& path, const Backend& backend, const Picture& picture,
                           const RendererOptions& renderer,
                           const std::vector<std::pair<std::string, std::string>>& more)
{
    const auto devices = backend.devices();
    const auto number = static_cast<std::size_t>(renderer.device);
    const char* instructions = std::getenv("MANDELMARCH_INSTRUCTIONS");
    const Device device = number < devices.size() ? devices[number] : Device{};
    nlohmann::ordered_json json{
        {"path", digest(to_text(path))},
        {"frames", path.frames.size()},
        {"width", picture.width},
        {"height", picture.height},
        {"samples", picture.samples},
        {"look", picture.look.value_or(-1)},
        {"equirectangular", picture.projection == Projection::equirectangular},
        {"stereo", picture.stereo},
        {"backend", backend.name()},
        {"device", device.name},
        {"driver", device.driver},
        {"instructions", instructions != nullptr ? instructions : ""},
        {"precision", name_of(renderer.precision)},
        {"mode", name_of(renderer.mode)},
        {"program", digest_of_file("/proc/self/exe")},
    };
    for (const auto& [name, value] : more) json[name] = value;
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace mandelmarch
