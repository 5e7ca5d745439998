// SPDX-License-Identifier: Apache-2.0
// The table of the study `demo`.
#pragma once

#include <string>
#include <vector>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Returns the rows in the order of the table: by fractal, backend and mode. A backend without a device has one row for
// each fractal.
std::vector<Row> demo_rows(const Result& result);

// Returns the reason why a row has no time or, if it has one, the result of its verification.
const std::string& remark(const Row& row);

// Returns the row's speed divided by the reference's speed in exact mode; 0 if it is unknown.
double speed_up(const Row& row);

std::string demo_table(const Result& result);

}  // namespace mandelmarch::bench
