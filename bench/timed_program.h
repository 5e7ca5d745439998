// SPDX-License-Identifier: Apache-2.0
// Runs an external program once and measures it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mandelmarch::bench {

struct Ended {
    double seconds = 0;          // wall time from start to end
    double processor = 0;        // user and system time of all its threads, seconds
    std::uint64_t memory = 0;    // peak resident bytes of its largest process
    std::optional<int> code;     // exit code
    std::optional<int> signal;   // signal that ended it, if any
    bool timed_out = false;      // killed at the time limit
    std::string complaint = {};  // last line of its standard error
};

// Runs the file words[0] with the other words as arguments in `folder`, without input and with its standard output
// discarded. Its standard error is kept in the file `complaints`. When it ends, or after `limit` seconds, it and the
// processes of its group are killed; if this process ends first, the program is killed. Its files may not exceed 1 GiB.
// Throws Error if it cannot be started.
Ended run_timed(const std::vector<std::string>& words, const std::string& folder, const std::string& complaints,
                double limit);

}  // namespace mandelmarch::bench
