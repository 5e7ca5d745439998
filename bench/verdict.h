// SPDX-License-Identifier: Apache-2.0
// Verdicts on measured ratios, for compare, duel and the summary of a study.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics.h"

namespace mandelmarch::bench {

inline constexpr double margin = 0.02;        // ratios from 1 / (1 + margin) to 1 + margin are never called different
inline constexpr double significance = 0.05;  // probability of any false alarm among all ratios judged together

enum class Verdict {
    faster,        // by more than the margin
    slower,        // by more than the margin
    same,          // within the margin
    undecided,     // the interval allows both; more runs would decide
    broken,        // the old result has a speed, the new one a wrong picture or a failure
    lost,          // comparable in the old result, but not in the new one
    added,         // only the new result has a speed
    not_compared,  // neither result has a comparable speed
    no_speed       // the old program of a duel has no speed
};
std::string_view name_of(Verdict verdict);

struct Judgement {
    Verdict verdict = Verdict::undecided;  // one of the first four
    double p = 1;                          // after Holm's correction
};

// Judges several ratios new / old together. The differences must come from tests with the margin `within`. A ratio is
//   - faster or slower, if the test for a ratio beyond the margin is significant after Holm's correction over all
//     ratios, so that at most 5 in 100 studies of equal programs report a difference;
//   - the same, if its own 95 % interval lies within the margin;
//   - else undecided.
std::vector<Judgement> judge_all(std::span<const Difference> differences, double within);

// Returns the number of configurations with each verdict, and an option that decides the undecided ones: "1 faster, 2
// same within 2 %, 4 undecided (more runs would tell: --runs)". Empty if there are no verdicts.
std::string summary_of(std::span<const Verdict> verdicts, double within);

}  // namespace mandelmarch::bench
