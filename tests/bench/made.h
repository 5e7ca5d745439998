// SPDX-License-Identifier: Apache-2.0
// Functions that make synthetic results of bench.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "bench/result/figures.h"
#include "bench/statistics/verdict.h"

namespace mandelmarch::bench {

// Returns a row with samples of these kernel times, in this order. Each run has `each` samples, but the last run may
// have fewer.
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
    result.environment["backends"] = {{{"name", "openmp"}, {"role", "host"}},
                                      {{"name", "reference"}, {"role", "reference"}}};
    result.rows = std::move(rows);
    return derived(std::move(result));
}

// Returns the number of rows whose verdict is `faster` or `slower`.
inline int called(const std::vector<Compared>& rows)
{
    return static_cast<int>(std::ranges::count(rows, Verdict::faster, &Compared::verdict) +
                            std::ranges::count(rows, Verdict::slower, &Compared::verdict));
}

inline double same(int /*row*/) { return 1; }

}  // namespace mandelmarch::bench
