// SPDX-License-Identifier: Apache-2.0
#include "apps/stats.h"

#include <nlohmann/json.hpp>

#include "core/os/output_file.h"
#include "core/scene/fractal.h"

namespace mandelmarch {

void write_stats(const std::string& path, const Scene& scene, const RenderStats& report, const Survey& survey,
                 const std::vector<std::string>& warnings)
{
    const Timings& t = report.timings;
    auto kernels = nlohmann::ordered_json::array();
    for (const KernelResources& k : report.kernels) {
        kernels.push_back({{"name", k.kernel}, {"registers", k.registers}, {"local_bytes", k.local_bytes}});
    }
    const nlohmann::ordered_json json{
        {"schema", 1},
        {"fractal", scene.fractal->name},
        {"width", scene.width},
        {"height", scene.height},
        {"backend", report.backend},
        {"device",
         {{"name", report.device.name},
          {"vendor", report.device.vendor},
          {"driver", report.device.driver},
          {"is_gpu", report.device.is_gpu}}},
        {"precision", name_of(report.precision)},
        {"mode", name_of(report.mode)},
        {"threads", report.threads},
        {"simd_width", report.simd_width},
        {"instruction_set", report.instruction_set},
        {"step_factor", report.step_factor > 0 ? nlohmann::ordered_json(report.step_factor) : nlohmann::ordered_json()},
        {"unsettled", report.unsettled},
        {"survey",
         {{"rays", survey.rays},
          {"hit", survey.hit},
          {"out_of_steps", survey.out_of_steps},
          {"in_solid", survey.inside},
          {"lost_in_float", survey.lost}}},
        {"warnings", warnings},
        {"seconds",
         {{"context", t.context},
          {"build", t.build},
          {"upload", t.upload},
          {"kernel", t.kernel},
          {"host", t.host},
          {"readback", t.readback},
          {"wall", t.wall}}},
        {"work",
         {{"steps", report.work.steps}, {"de_calls", report.work.de_calls}, {"iterations", report.work.iterations}}},
        {"kernels", kernels},
    };
    // A driver's name is not always valid UTF-8.
    write_file(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace mandelmarch
