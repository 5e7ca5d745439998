// SPDX-License-Identifier: Apache-2.0
// bench compare: two results, row by row.
#pragma once

#include <string>
#include <vector>

#include "bench/result.h"
#include "bench/statistics.h"
#include "bench/verdict.h"

namespace mandelmarch::bench {

struct Compared {
    std::string name;
    std::string platform;
    Verdict verdict = Verdict::not_compared;
    std::string why{};                 // where nothing was tested
    Difference difference{};           // of kernel times, new / old
    double p = 1;                      // after Holm's correction
    int old_units = 0, new_units = 0;  // medians of launches, or of groups of samples where there is one launch
};

struct ComparedResults {
    std::vector<Compared> rows;
    std::vector<std::string> differences;  // of the environments
    std::vector<std::string> warnings;     // the results' own, too

    // A row is slower, or had a speed and has none now that could be compared.
    bool regression() const;
};

// Pairs rows by name and platform, told apart as told_apart() does. The units of the test are the medians of the
// launches, as samples of one process share its memory layout and clock and are not independent; where either result
// has one launch only, they are the medians of groups of three rounds and more, with a warning that differences between
// launches are unseen. A row that could be compared in the old result and cannot in the new one (it is missing,
// unavailable, failed, of another setting, without enough times above 0) is lost; a row that only the new result has a
// speed for is added. Throws InputError where the results have no row in common.
ComparedResults compare_results(const Result& old_given, const Result& new_given);

std::string to_console(const ComparedResults& comparison);

}  // namespace mandelmarch::bench
