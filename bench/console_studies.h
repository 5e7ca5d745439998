// SPDX-License-Identifier: Apache-2.0
// The console's tables of single studies, and how numbers are printed. Internal to the console reporter.
#pragma once

#include <string>

#include "bench/result.h"

namespace mandelmarch::bench {

// Four digits or so.
std::string digits(double value);

// At most `most` characters.
std::string clipped(const std::string& line, std::size_t most);

// What the studies profile and box-vs-bulb found; empty for others.
std::string study_tables(const Result& result);

}  // namespace mandelmarch::bench
