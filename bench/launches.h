// SPDX-License-Identifier: Apache-2.0
// Repeats a study in several runs, each a fresh process of bench, and merges their samples.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/result.h"

namespace mandelmarch::bench {

// Executes one run and returns its result. Throws Error if it left none.
using Run = std::function<Result(int launch)>;

// Merges results: all samples, tagged by run; the highest peaks; everything else from the first run. A configuration
// that fails in any run fails.
Result merged(std::vector<Result> results);

// Merges `first` with the results of runs 1 to count - 1. A run without a result adds a warning and a line on stderr;
// Result::launches counts the runs with a result.
Result with_further_launches(Result first, int count, const Run& launch);

// Starts this program with the given arguments and `--launch N --json - --quiet`, and parses its output. Throws Error
// if the process leaves no result.
Result launch_again(const std::vector<std::string>& arguments, int launch);

}  // namespace mandelmarch::bench
