// SPDX-License-Identifier: Apache-2.0
// The judge of compare, duel and the last lines of a study: what a measured ratio says.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics.h"

namespace mandelmarch::bench {

inline constexpr double margin = 0.02;        // a ratio within this of 1 is never called a difference
inline constexpr double significance = 0.05;  // of all that are judged together

enum class Verdict {
    faster,        // by more than the margin
    slower,        // by more than the margin
    same,          // within the margin
    undecided,     // the interval holds both: more launches would tell
    broken,        // the old result has a speed, the new one has a wrong picture or a failure
    lost,          // it could be compared in the old result and cannot in the new one
    added,         // only the new result has a speed
    not_compared,  // neither has one that can be compared
    no_speed       // the old program of a duel has none
};
std::string_view name_of(Verdict verdict);

struct Judgement {
    Verdict verdict = Verdict::undecided;  // one of the first four
    double p = 1;                          // after Holm's correction
};

// Of ratios new / old that stand together. Faster or slower: the test of a ratio beyond the margin is significant after
// Holm's correction for all of them, so that at most 5 in 100 studies of equal things call any of them different. Same:
// the ratio's own 95 % interval lies within the margin. All were tested with the margin that is given.
std::vector<Judgement> judge_all(std::span<const Difference> differences, double within);

// How many rows there are of each verdict, and what would decide the undecided ones: "1 faster, 2 same within 2 %, 4
// undecided (more launches would tell: --launches)". Empty without any.
std::string summary_of(std::span<const Verdict> verdicts, double within);

}  // namespace mandelmarch::bench
