// SPDX-License-Identifier: Apache-2.0
// Console tables of single studies, and helpers that format numbers and lines for the console.
#pragma once

#include <cstddef>
#include <string>

#include "bench/result.h"

namespace mandelmarch::bench {

// Maximum length of a line of a table, in characters, and of a warning, in bytes.
inline constexpr std::size_t console_columns = 120;
inline constexpr std::size_t longest_note = 1000;

// Formats a value with about four significant digits.
std::string digits(double value);

// Truncates a line to `most` characters.
std::string clipped(const std::string& line, std::size_t most);

// Returns the tables of the studies profile and box-vs-bulb; empty for other studies.
std::string study_tables(const Result& result);

}  // namespace mandelmarch::bench
