// SPDX-License-Identifier: Apache-2.0
#include "flight/film/summary.h"

#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "core/scene/fractal.h"

namespace mandelmarch {

std::string summary_of(const Path& path, const Backend& backend, const FilmOptions& options, const FilmStats& report,
                       int processes)
{
    const auto devices = backend.devices();
    const auto number = static_cast<std::size_t>(options.renderer.device);
    const Device device = number < devices.size() ? devices[number] : Device{};
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
        {"threads", options.renderer.threads},
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
