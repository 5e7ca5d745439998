// SPDX-License-Identifier: Apache-2.0
#include "apps/demo_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/cores.h"
#include "core/base/cpu.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/version.h"
#include "core/image/formats/image_file.h"

namespace mandelmarch {

DemoFolder::DemoFolder(std::string path) : path_(std::move(path))
{
    if (path_.empty()) return;
    std::error_code failure;
    std::filesystem::create_directories(path_, failure);
    if (failure) throw Error(fmt::format("{}: {}", path_, failure.message()));
}

void DemoFolder::picture(DemoRow& row, const Image& image) const
{
    if (path_.empty()) return;
    row.picture = fmt::format("{}-{}{}-{}-{}.png", row.fractal, row.backend, row.simd_width == 1 ? "-1" : "",
                              name_of(row.precision), name_of(row.mode));
    write_image(fmt::format("{}/{}", path_, row.picture), ImageFormat::png, image);
}

void DemoFolder::table(const std::vector<DemoRow>& rows, int side, int repetitions) const
{
    if (path_.empty()) return;
    nlohmann::ordered_json json{
        {"schema", 1},
        {"version", project_version()},
        {"revision", source_revision()},
        {"cpu", cpu_name()},
        {"threads", usable_threads()},
        {"side", side},
        {"repetitions", repetitions},
    };
    for (const DemoRow& row : rows) {
        json["rows"].push_back({
            {"fractal", row.fractal},
            {"backend", row.backend},
            {"simd_width", row.simd_width},
            {"precision", name_of(row.precision)},
            {"mode", name_of(row.mode)},
            {"drawn", row.drawn},
            {"fine", row.ok},
            {"said", row.said},
            {"device", row.device},
            {"wall_seconds", row.seconds},
            {"speed_up", row.speed_up},
            {"picture", row.picture},
        });
    }
    // A driver's name is not always valid UTF-8.
    write_file(path_ + "/demo.json", json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace mandelmarch
