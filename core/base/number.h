// SPDX-License-Identifier: Apache-2.0
// Strict decimal numbers, for files and command lines: no hexadecimal, no infinity, nothing after the number.
#pragma once

#include <optional>
#include <string_view>

namespace mandelmarch {

// Returns nullopt if `text` is not exactly one integer, or is out of range.
std::optional<long long> parse_whole(std::string_view text);

// Returns nullopt if `text` is not exactly one finite real number, or is out of the range of double.
std::optional<double> parse_real(std::string_view text);

}  // namespace mandelmarch
