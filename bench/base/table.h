// SPDX-License-Identifier: Apache-2.0
// Numbers and lines of tables for the console.
#pragma once

#include <cstddef>
#include <string>

namespace mandelmarch::bench {

// Maximum length of a line of a table, in characters, and of a warning, in bytes.
inline constexpr std::size_t console_columns = 120;
inline constexpr std::size_t longest_note = 1000;

// Formats a value with about four significant digits.
std::string digits(double value);

// Truncates a line to `most` characters.
std::string clipped(const std::string& line, std::size_t most);

}  // namespace mandelmarch::bench
