// SPDX-License-Identifier: Apache-2.0
// Winners of a standard study, for its summary.
#pragma once

#include <string>
#include <vector>

#include "bench/result/figures.h"
#include "bench/statistics/verdict.h"

namespace mandelmarch::bench {

// The timed configurations of one picture, that is, of one fractal and scene, in one precision and mode.
struct Ranking {
    const Row* fastest = nullptr;  // by the median kernel time
    // All other configurations, fastest first. Each ratio is the configuration's kernel time / that of `fastest`. If
    // the configuration and `fastest` have two runs, or six rounds of one run, in common, the verdict is slower, same
    // or undecided. Otherwise the verdict is no_speed, and of the difference only the ratio is set.
    std::vector<Compared> others;
};

// Returns the rankings of a standard study, without the reference, which is not an application; empty for other
// studies. Two configurations are compared by the ratios of their kernel times in the same run and round. If there are
// several runs, the test uses the median ratio of each run; otherwise it uses the median ratios of groups of three or
// more rounds. Holm's correction covers all of their verdicts.
std::vector<Ranking> rankings_of(const Result& result);

// Returns a line for each ranking, with the lead of the fastest configuration and its certainty, and a last line with
// the number of processors that were free.
std::string winners(const Result& result);

}  // namespace mandelmarch::bench
