// SPDX-License-Identifier: Apache-2.0
// bench compare: compares two results, configuration by configuration.
#pragma once

#include <string>
#include <vector>

#include "bench/result/result.h"
#include "bench/statistics/statistics.h"
#include "bench/statistics/verdict.h"

namespace mandelmarch::bench {

struct ComparedResults {
    std::vector<Compared> rows;
    std::vector<std::string> differences;  // between the environments
    std::vector<std::string> warnings;     // including the warnings of both results
};

// Compares the configurations that have the same name and platform in both results, after disambiguated().
//
// The test compares medians of runs, not samples: the samples of one process share its memory layout and clock
// frequency, so they are not independent. If either result has only one run, the test compares medians of groups of
// three or more rounds, and a warning says that differences between runs are unseen.
//
// If only the old result has a comparable speed for a configuration, the configuration is
//   wrong, if its picture is wrong or it failed in the new result;
//   missing, if the new result does not have it, could not measure it, or has it with another setting, too few samples
//     or a time that is not above 0.
// If only the new result has a speed for a configuration, the configuration is new.
//
// Throws InputError if the results have no configuration in common.
ComparedResults compare_results(const Result& old_given, const Result& new_given);

std::string to_console(const ComparedResults& comparison);

}  // namespace mandelmarch::bench
