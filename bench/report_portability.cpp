// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "bench/portability.h"
#include "bench/report.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

nlohmann::ordered_json json_of(const std::vector<Portability>& portabilities)
{
    Json list = Json::array();
    for (const Portability& p : portabilities) {
        Json platforms = Json::array();
        for (const OnPlatform& on : p.platforms) {
            platforms.push_back({{"platform", on.platform},
                                 {"kernel_seconds", on.seconds > 0 ? Json(on.seconds) : Json()},
                                 {"application_efficiency", on.application},
                                 {"share_of_peak", on.architecture}});
        }
        Json cascade = Json::array();
        for (const CascadeStep& step : p.cascade) {
            cascade.push_back(
                {{"platform", step.platform}, {"efficiency", step.efficiency}, {"portability", step.portability}});
        }
        list.push_back(
            {{"problem", p.problem},
             {"fractal", p.fractal},
             {"precision", name_of(p.precision)},
             {"mode", name_of(p.mode)},
             {"application", p.application},
             {"by_application_efficiency", p.application_portability},
             {"by_application_efficiency_interval", {p.application_interval.low, p.application_interval.high}},
             {"by_share_of_peak", p.architecture_portability},
             {"by_share_of_peak_interval", {p.architecture_interval.low, p.architecture_interval.high}},
             {"platforms", platforms},
             {"cascade", cascade}});
    }
    return list;
}

std::string to_csv(const std::vector<Portability>& portabilities)
{
    std::string text = "problem,application,platform,fom\n";
    for (const Portability& p : portabilities) {
        for (const OnPlatform& on : p.platforms) {
            if (!(on.seconds > 0)) continue;
            text += fmt::format(
                "{},{},{},{}\n", csv_cell(problem_name(p.fractal, p.precision, p.mode, p.width, p.height)),
                csv_cell(p.application), csv_cell(on.platform), static_cast<double>(p.width) * p.height / on.seconds);
        }
    }
    return text;
}

std::string to_console(const std::vector<Portability>& portabilities)
{
    std::string text = fmt::format("{:<22} {:<6} {:<5} {:<10} {:>3}  {:>7} {:<18} {:>7} {}\n", "problem", "number",
                                   "mode", "backend", "H", "PP app", "95 %", "PP peak", "95 %");
    for (const Portability& p : portabilities) {
        text += fmt::format("{:<22} {:<6} {:<5} {:<10} {:>3}  {:>7.3f} {:<18} {:>7.3f} {}\n", printable(p.problem, 100),
                            name_of(p.precision), name_of(p.mode), printable(p.application, 100), p.platforms.size(),
                            p.application_portability,
                            fmt::format("[{:.3f}, {:.3f}]", p.application_interval.low, p.application_interval.high),
                            p.architecture_portability,
                            fmt::format("[{:.3f}, {:.3f}]", p.architecture_interval.low, p.architecture_interval.high));
    }
    return text;
}

}  // namespace mandelmarch::bench
