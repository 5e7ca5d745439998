// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "bench/divergence.h"
#include "bench/report.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

// Formats lines as defined by p3-analysis-library's coverage.schema.
std::string coverage_text(const Coverage& coverage)
{
    Json list = Json::array();
    for (const auto& [file, used] : coverage) {
        list.push_back({{"file", file}, {"id", file}, {"used_lines", used}, {"unused_lines", Json::array()}});
    }
    return list.dump();
}

}  // namespace

Json json_of(const Divergence& divergence)
{
    Json models = Json::array();
    for (const ModelLines& one : divergence.models) {
        Json distances = Json::object();
        for (const ModelLines& other : divergence.models)
            distances[other.backend] = distance(one.coverage, other.coverage);
        models.push_back({{"backend", one.backend},
                          {"lines", one.own},
                          {"lines_of_job", one.job},
                          {"lines_of_kernel", one.kernel},
                          {"distances", distances}});
    }
    return {{"schema", "mandelmarch-divergence"},
            {"version", 1},
            {"models", models},
            {"convergence", 1 - divergence.divergence},
            {"convergence_without_one_text", 1 - divergence.without_one_text}};
}

std::string to_csv(const Divergence& divergence)
{
    std::string text = "problem,application,platform,coverage\n";
    for (const ModelLines& model : divergence.models) {
        text +=
            fmt::format("all,mandelmarch,{},{}\n", csv_cell(model.backend), csv_cell(coverage_text(model.coverage)));
    }
    return text;
}

std::string to_console(const Divergence& divergence)
{
    std::string text = "Code divergence: lines of code that backends need, and how few of them they share\n";
    text += fmt::format("{:<10} {:>8} {:>8} {:>11}  code distance from the others\n", "backend", "lines", "core/job",
                        "core/kernel");
    for (const ModelLines& one : divergence.models) {
        text += fmt::format("{:<10} {:>8} {:>8} {:>11} ", one.backend, one.own, one.job, one.kernel);
        for (const ModelLines& other : divergence.models)
            text += fmt::format(" {:.2f}", distance(one.coverage, other.coverage));
        text += '\n';
    }
    return text + fmt::format("code convergence: {:.3f}; with a kernel text for each it would be {:.3f}\n",
                              1 - divergence.divergence, 1 - divergence.without_one_text);
}

}  // namespace mandelmarch::bench
