// SPDX-License-Identifier: Apache-2.0
// Console output: messages on stderr, results on stdout.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace mandelmarch {

// Prints a message to stderr, unchanged. If stderr cannot be written, the message is lost and the program continues.
void say(std::string_view text);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values)
{
    say(std::string_view(fmt::format(format, std::forward<Values>(values)...)));
}

// Prints a result to stdout, which is buffered until run_program() flushes it. Throws Error if stdout cannot be
// written, but not if its reader has closed the pipe.
void print(std::string_view text);

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values)
{
    print(std::string_view(fmt::format(format, std::forward<Values>(values)...)));
}

// Flushes stdout. Throws Error if this or an earlier write failed.
void flush_stdout();

}  // namespace mandelmarch
