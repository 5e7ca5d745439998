// SPDX-License-Identifier: Apache-2.0
// Functions for text from outside the program: they make it printable, divide it, and check it before it is parsed.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mandelmarch {

inline constexpr std::size_t longest_message = 2000;  // bytes

// Returns the text as one line. Control characters are escaped as in C (\n, \x1b), and bytes that are not UTF-8 as
// \xNN. If the result is longer than `most` bytes, it is cut and ends with "...".
std::string printable(std::string_view text, std::size_t most = longest_message);

inline constexpr std::string_view blanks = " \t\r\n\f\v";

// Returns the text without the blanks at its beginning and end.
std::string_view trimmed(std::string_view text);

// Returns the parts between separators, also empty ones; a text without separators is one part.
std::vector<std::string_view> split(std::string_view text, char separator);

// Returns what `function`, such as a pointer to a member, gives for each element of the list.
template <class List, class Function>
auto mapped(const List& list, const Function& function)
{
    std::vector<std::decay_t<std::invoke_result_t<Function, decltype(*std::begin(list))>>> values;
    for (const auto& element : list) values.push_back(std::invoke(function, element));
    return values;
}

inline constexpr std::size_t deepest_json = 64;

// Throws InputError if the brackets of a JSON text are nested deeper than `deepest_json`. JSON readers are recursive,
// so deeper texts could exhaust the stack. The message begins with `name`.
void check_json_depth(std::string_view text, const std::string& name);

}  // namespace mandelmarch
