// SPDX-License-Identifier: Apache-2.0
// Functions that make synthetic results of bench.
#pragma once

#include <string>
#include <vector>

#include "bench/result/figures.h"

namespace mandelmarch::bench {

// Returns a row with the samples in the given order, `each` of them per run.
inline Row made_row(const std::string& backend, const std::vector<double>& seconds, int each = 1000)
{
    Row row;
    row.fractal = "mandelbox";
    row.precision = Precision::f32;
    row.backend = backend;
    row.platform = row.device_name = "machine";
    row.verification.drawn = row.verification.passed = true;
    row.setting.width = row.setting.height = 100;
    for (int i = 0; i < static_cast<int>(seconds.size()); ++i) {
        const double kernel = seconds[static_cast<std::size_t>(i)];
        row.samples.push_back(
            {.run = i / each, .round = i % each, .kernel = kernel, .wall = 2 * kernel, .readback = kernel / 8});
    }
    return row;
}

inline Result made_result(std::vector<Row> rows, int runs = 1)
{
    Result result;
    result.study = "standard";
    result.runs = runs;
    result.environment = nlohmann::ordered_json::object();
    result.rows = std::move(rows);
    return derived(std::move(result));
}

}  // namespace mandelmarch::bench
