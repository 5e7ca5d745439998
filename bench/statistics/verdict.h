// SPDX-License-Identifier: Apache-2.0
// Verdicts on measured ratios, for compare and the summary of a study.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics/statistics.h"
#include "bench/statistics/table.h"

namespace mandelmarch::bench {

inline constexpr double margin = 0.02;        // true ratios from 1 / (1 + margin) to 1 + margin count as the same
inline constexpr double significance = 0.05;  // max probability of a false alarm among all ratios compared together

enum class Verdict {
    faster,        // by more than the margin
    slower,        // by more than the margin
    same,          // within the margin
    undecided,     // none of these three; more runs would decide
    wrong,         // the old side has a speed; the new side has a wrong picture or failed
    missing,       // comparable in the old result, but not in the new one
    only_new,      // only the new result has a speed
    not_compared,  // the old result has no comparable speed, and the verdict is not only_new
    no_speed       // not tested: there are too few times
};
std::string_view name_of(Verdict verdict);

// A configuration whose times were compared.
struct Compared {
    std::string name;
    Verdict verdict = Verdict::not_compared;
    std::string why{};        // the reason why the ratio was not tested; empty if it was tested
    Difference difference{};  // the test of the times' ratio, new / old
    double p = 1;             // after Holm's correction
    // Numbers of compared medians: one median for each run, or for each group of samples if there is only one run.
    int old_units = 0, new_units = 0;
};

// Sets the verdicts of the configurations whose verdict is `undecided`, all together. Their differences must come from
// tests with the margin `within`. A configuration is
//   - faster or slower, if the test for a ratio beyond the margin is significant after Holm's correction over all
//     ratios. Then at most 5 in 100 studies of equal programs report a difference;
//   - the same, if the 95 % interval of its ratio, without the correction, lies within the margin;
//   - else undecided.
void set_verdicts(std::vector<Compared>& rows, double within);

// Returns true if a configuration is slower, wrong or missing in the new result.
bool regression(const std::vector<Compared>& rows);

// Returns a table of the verdicts, in lines of at most 120 characters.
std::string table_of(const std::vector<Compared>& rows);

// Returns a line with the number of configurations with each verdict: "verdicts: 1 faster, 2 same within 2 %, 4
// undecided (more runs would tell: --runs)". The verdicts new, no speed and not compared are left out. Returns an empty
// text if there are no others.
std::string summary_of(const std::vector<Compared>& rows, double within);

}  // namespace mandelmarch::bench
