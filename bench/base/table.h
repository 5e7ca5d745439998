// SPDX-License-Identifier: Apache-2.0
// Numbers and lines of tables for the console.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/base/statistics.h"

namespace mandelmarch::bench {

// Maximum length of a line of a table, in characters, and of a warning, in bytes.
inline constexpr std::size_t console_columns = 120;
inline constexpr std::size_t longest_note = 1000;

// Formats a value with about four significant digits.
std::string digits(double value);

// Formats an interval, whose ends are multiplied by `unit`: "[12.30, 12.45]".
std::string interval_text(const Interval& interval, double unit = 1);

// Returns a line for each text, with `start` before it; unprintable characters are replaced and long lines truncated.
std::string notes(const std::string& start, const std::vector<std::string>& texts);

// Truncates a line to `most` characters.
std::string clipped(const std::string& line, std::size_t most);

}  // namespace mandelmarch::bench
