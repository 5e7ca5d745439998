// SPDX-License-Identifier: Apache-2.0
// Strict parsing of decimal numbers, for files and command lines. Hexadecimal, infinity, and text after the number are
// not accepted.
#pragma once

#include <optional>
#include <string_view>

namespace mandelmarch {

// Returns the integer that `text` consists of; nullopt if it is anything else or out of range.
std::optional<long long> parse_whole(std::string_view text);

// Returns the finite real number that `text` consists of; nullopt if it is anything else or out of the range of double.
std::optional<double> parse_real(std::string_view text);

}  // namespace mandelmarch
