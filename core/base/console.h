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

// Prints a result to stdout. Throws Error if it cannot be written; a pipe closed by its reader is not an error. The
// output is buffered; run_program flushes it.
void print(std::string_view text);

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values)
{
    print(std::string_view(fmt::format(format, std::forward<Values>(values)...)));
}

// Flushes stdout. Throws Error if this fails, or failed before.
void flush_stdout();

}  // namespace mandelmarch
