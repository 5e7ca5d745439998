// SPDX-License-Identifier: Apache-2.0
// Repeats a study in several runs, each a fresh process of bench, and merges their samples.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Executes the run with this number and returns its result. Throws Error if the run has no result.
using RunProcess = std::function<Result(int run)>;

// Executes runs until there are `count`, or until Ctrl+C, and merges their results with `first`, the result of the
// earlier ones: keeps the samples and warnings of all runs and the highest peaks, and takes everything else from the
// first. A configuration that fails in any run fails in the merged result. For a run without a result, adds a warning
// and prints a line on stderr. Result::runs is the number of runs with a result.
Result with_further_runs(Result first, int count, const RunProcess& run);

// Starts this program with the given arguments and `--run N`, where N is `run`, and parses the result that it prints.
// Throws Error if the process prints no result.
Result run_again(const std::vector<std::string>& arguments, int run);

}  // namespace mandelmarch::bench
