// SPDX-License-Identifier: Apache-2.0
// External text: printing it in messages, and checks before parsing.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mandelmarch {

inline constexpr std::size_t longest_message = 2000;  // bytes

// Returns the text as one line: control characters escaped as in C (\n, \x1b), bytes that are not UTF-8 as \xNN, cut
// with "..." if longer than `most` bytes.
std::string printable(std::string_view text, std::size_t most = longest_message);

inline constexpr std::size_t deepest_json = 64;

// Throws InputError, with a message that begins with `name`, if brackets of a JSON text are nested deeper than
// `deepest_json`, because JSON readers recurse.
void check_json_depth(std::string_view text, const std::string& name);

}  // namespace mandelmarch
