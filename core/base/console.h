// SPDX-License-Identifier: Apache-2.0
// What programs say: notes on stderr, results on stdout.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace mandelmarch {

// A note for the user on stderr, as it stands. Where stderr cannot be written the note is lost and the work goes on.
void say(std::string_view text);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values)
{
    say(std::string_view(fmt::format(format, std::forward<Values>(values)...)));
}

// Prints a result to stdout. Throws Error if it cannot be written; a pipe that its reader has closed is no error. The
// output is buffered; run_program flushes it.
void print(std::string_view text);

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values)
{
    print(std::string_view(fmt::format(format, std::forward<Values>(values)...)));
}

// Writes out what stdout buffers. Throws Error where that fails, or has failed before.
void flush_stdout();

}  // namespace mandelmarch
