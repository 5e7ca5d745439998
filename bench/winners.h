// SPDX-License-Identifier: Apache-2.0
// Who won: the last lines of a standard study.
#pragma once

#include <string>
#include <vector>

#include "bench/figures.h"
#include "bench/verdict.h"

namespace mandelmarch::bench {

// One that was slower than the fastest, or cannot be told from it.
struct Rival {
    const Row* row = nullptr;
    bool tested = false;      // there are two launches, or six rounds of one, with both
    Difference difference{};  // of kernel times, this one's / the fastest's, where it was tested; else only the ratio
    Judgement judgement{};    // slower, the same or undecided
};

// One fractal in one precision and mode.
struct Contest {
    const Row* fastest = nullptr;  // by the median kernel time
    std::vector<Rival> rivals;     // all others, the fastest of them first
};

// Of a standard study's timed rows but for the reference, which is no application. A rival's units are the ratios of
// both rows' kernel times of the same launch and round: of several launches their medians, of one the medians of groups
// of three rounds. The p-values are corrected for all rivals of all contests.
std::vector<Contest> contests_of(const Result& result);

// A line for each contest: by how much the fastest won, and how certain that is; and one for how many processors were
// free for it.
std::string winners(const Result& result);

}  // namespace mandelmarch::bench
