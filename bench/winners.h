// SPDX-License-Identifier: Apache-2.0
// The winners of a standard study, which its last lines name.
#pragma once

#include <string>
#include <vector>

#include "bench/figures.h"
#include "bench/verdict.h"

namespace mandelmarch::bench {

// A row that was slower than the fastest, or cannot be distinguished from it.
struct Rival {
    const Row* row = nullptr;
    bool tested = false;      // at least two launches, or six rounds of one launch, have both
    Difference difference{};  // of kernel times, this row's / the fastest's; if it was not tested, the ratio alone
    Judgement judgement{};    // slower, the same or undecided
};

// One fractal in one precision and mode.
struct Contest {
    const Row* fastest = nullptr;  // by the median kernel time
    std::vector<Rival> rivals;     // all others, the fastest of them first
};

// The contests among a standard study's timed rows, without the reference, which is no application. Two rows are
// compared by the ratios of their kernel times in the same launch and round: each launch's median if there are several
// launches, else the medians of groups of three rounds. The p-values are corrected for all rivals of all contests.
std::vector<Contest> contests_of(const Result& result);

// A line for each contest: by how much the fastest won, and how certain that is; and a last line with the number of
// processors that were free.
std::string winners(const Result& result);

}  // namespace mandelmarch::bench
