// SPDX-License-Identifier: Apache-2.0
// Strict decimal numbers, for files and command lines: no hexadecimal, no infinity, no rest behind the number.
#pragma once

#include <optional>
#include <string_view>

namespace mandelmarch {

// nullopt where `text` is not one whole number, or does not fit.
std::optional<long long> parse_whole(std::string_view text);

// nullopt where `text` is not one finite real number, or is too large or too small for a double.
std::optional<double> parse_real(std::string_view text);

}  // namespace mandelmarch
