// SPDX-License-Identifier: Apache-2.0
// Several launches: the study run by fresh processes of this program, their samples put together.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/result.h"

namespace mandelmarch::bench {

// Runs one launch and returns the result that it left. Throws Error where it left none.
using Launch = std::function<Result(int launch)>;

// The samples of all launches, tagged by launch, in one result; everything else from the first launch, peaks the
// highest of all. A row that fails in any launch fails.
Result merged(std::vector<Result> results);

// `first` merged with what the launches 1 to count - 1 leave. A launch that leaves nothing is a warning of the result
// and a line on stderr; Result::launches counts those that left something.
Result with_further_launches(Result first, int count, const Launch& launch);

// Runs this program again with the given arguments and `--launch N --json - --quiet`, and reads what it prints. Throws
// Error where the process leaves no result.
Result launch_again(const std::vector<std::string>& arguments, int launch);

}  // namespace mandelmarch::bench
