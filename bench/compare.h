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
    std::string why{};                 // if nothing was tested
    Difference difference{};           // of kernel times, new / old
    double p = 1;                      // after Holm's correction
    int old_units = 0, new_units = 0;  // medians of runs, or of groups of samples if there is only one run
};

struct ComparedResults {
    std::vector<Compared> rows;
    std::vector<std::string> differences;  // between the environments
    std::vector<std::string> warnings;     // including those of the results

    // Returns true if a configuration is slower, or had a comparable speed and has none now.
    bool regression() const;
};

// Pairs configurations by name and platform, after disambiguated(). The test compares medians of runs, as samples of
// one process share its memory layout and clock frequency and are not independent. If either result has only one run,
// it compares medians of groups of three or more rounds and warns that differences between runs are unseen. A
// configuration is lost if the old result has a comparable speed for it and the new one does not (missing, unavailable,
// failed, other setting, too few times above 0). It is added if only the new result has a speed for it. Throws
// InputError if the results have no configuration in common.
ComparedResults compare_results(const Result& old_given, const Result& new_given);

std::string to_console(const ComparedResults& comparison);

}  // namespace mandelmarch::bench
