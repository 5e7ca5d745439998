// SPDX-License-Identifier: Apache-2.0
// The table of the study `demo`, in lines that anybody can read.
#pragma once

#include <string>
#include <vector>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Returns the rows in the order of the table: by fractal, backend and mode. A backend without a device has a row for
// each fractal.
std::vector<Row> demo_rows(const Result& result);

// Returns the reason why a row has no time; the result of its verification if it has one.
const std::string& remark(const Row& row);

// Returns how many times as fast as the reference in exact mode a row is; 0: unknown.
double speed_up(const Row& row);

std::string demo_table(const Result& result);

}  // namespace mandelmarch::bench
