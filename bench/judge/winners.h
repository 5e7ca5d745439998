// SPDX-License-Identifier: Apache-2.0
// Winners of a standard study, for its summary.
#pragma once

#include <string>
#include <vector>

#include "bench/result/figures.h"
#include "bench/judge/verdict.h"

namespace mandelmarch::bench {

// The timed configurations of one fractal in one precision and mode.
struct Contest {
    const Row* fastest = nullptr;  // by the median kernel time
    // All other configurations, fastest first; each ratio is a kernel time / the fastest's. Verdicts are slower, same
    // or undecided. The verdict is no_speed, with the ratio only, if a configuration and the fastest have neither two
    // runs in common nor, with only one run in common, six rounds of it.
    std::vector<Judged> rivals;
};

// Returns the contests among a standard study's timed configurations, without the reference, which is not an
// application. Two configurations are compared by the ratios of their kernel times in the same run and round. If there
// are several runs, the test uses the median of each run; else it uses the medians of groups of three rounds. The
// p-values are corrected over all rivals of all contests.
std::vector<Contest> contests_of(const Result& result);

// Returns a line for each contest with the winner's lead and its certainty, and a last line with the number of
// processors that were free.
std::string winners(const Result& result);

}  // namespace mandelmarch::bench
