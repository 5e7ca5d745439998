// SPDX-License-Identifier: Apache-2.0
// The console's tables of single studies, and how numbers and lines are printed. Internal to what prints on a console.
#pragma once

#include <cstddef>
#include <string>

#include "bench/result.h"

namespace mandelmarch::bench {

// Lines of tables, in characters, and of warnings, in bytes.
inline constexpr std::size_t console_columns = 120;
inline constexpr std::size_t longest_note = 1000;

// Four digits or so.
std::string digits(double value);

// At most `most` characters.
std::string clipped(const std::string& line, std::size_t most);

// What the studies profile and box-vs-bulb found; empty for others.
std::string study_tables(const Result& result);

}  // namespace mandelmarch::bench
