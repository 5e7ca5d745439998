// SPDX-License-Identifier: Apache-2.0
// bench compare: compares two results, configuration by configuration.
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
    std::string why{};        // why nothing was tested; empty if it was
    Difference difference{};  // of kernel times, new / old
    double p = 1;             // after Holm's correction
    // Numbers of compared medians: one for each run, or one for each group of samples if a result has one run only.
    int old_units = 0, new_units = 0;
};

struct ComparedResults {
    std::vector<Compared> rows;
    std::vector<std::string> differences;  // between the environments
    std::vector<std::string> warnings;     // including the warnings of both results

    // Returns true if a configuration is slower in the new result, or has a comparable speed in the old result only.
    bool regression() const;
};

// Compares the configurations that have the same name and platform in both results, after disambiguated().
//
// The test compares medians of runs: samples of one process share its memory layout and clock frequency, so they are
// not independent. If either result has only one run, the test compares medians of groups of three or more rounds, and
// a warning says that differences between runs are unseen.
//
// If only the old result has a comparable speed for a configuration, the configuration is
//   broken, if its picture is wrong or it failed in the new result;
//   lost, if it is missing or unavailable there, or has another setting, too few samples or a time that is not above 0.
// If only the new result has a speed for it, the configuration is added.
//
// Throws InputError if the results have no configuration in common.
ComparedResults compare_results(const Result& old_given, const Result& new_given);

std::string to_console(const ComparedResults& comparison);

}  // namespace mandelmarch::bench
