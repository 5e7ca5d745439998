// SPDX-License-Identifier: Apache-2.0
// A program of somebody else, run once, and what that took.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mandelmarch::bench {

struct Ended {
    double seconds = 0;          // wall, from its start to its end
    double processor = 0;        // seconds of all its threads, in user and system mode
    std::uint64_t memory = 0;    // bytes that were resident at most, of the largest of its processes
    std::optional<int> code;     // its exit code
    std::optional<int> signal;   // what ended it, if not by itself
    bool timed_out = false;      // it was ended at the limit
    std::string complaint = {};  // the last line that it wrote on standard error
};

// Runs words[0], a file, with the others as arguments in `folder`, without input and with its standard output thrown
// away; its standard error goes through the file `complaints`. What it started is ended with it, and all of it after
// `limit` seconds, or when this process ends. No file may grow beyond 1 GiB. Throws Error where it cannot be started.
Ended run_timed(const std::vector<std::string>& words, const std::string& folder, const std::string& complaints,
                double limit);

}  // namespace mandelmarch::bench
