// SPDX-License-Identifier: Apache-2.0
// Texts that come from outside: for messages, and before they are parsed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mandelmarch {

inline constexpr std::size_t longest_message = 2000;  // bytes

// The text in one line: control characters escaped as in C (\n, \x1b), bytes that are no UTF-8 as \xNN, and cut with
// "..." where it is longer than `most` bytes.
std::string printable(std::string_view text, std::size_t most = longest_message);

inline constexpr std::size_t deepest_json = 64;

// Throws InputError, which begins with `name`, where brackets of a JSON text are nested deeper than `deepest_json`: its
// readers use the stack.
void check_json_depth(std::string_view text, const std::string& name);

}  // namespace mandelmarch
