// Several launches: the study run by fresh processes of this program, their samples put together.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/result.h"

namespace mandelmarch::bench {

// Runs one launch and returns the result that it left.
using Launch = std::function<Result(int launch)>;

// The samples of all launches, tagged by launch, in one result; everything else from the first launch, peaks the
// highest of all. A row that fails in any launch fails.
Result merged(std::vector<Result> results);

// Runs this program again with the given arguments and `--launch N --json FILE --quiet`, and reads FILE. Throws Error
// where the process leaves no result.
Result launch_again(const std::vector<std::string>& arguments, int launch);

}  // namespace mandelmarch::bench
