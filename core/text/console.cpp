// SPDX-License-Identifier: Apache-2.0
#include "core/text/console.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "core/text/error.h"

namespace mandelmarch {
namespace {

// Handles a failed write to stdout. Throws Error unless the cause is a closed pipe. A reader that closes the pipe, such
// as `| head -1`, has read all that it needs, so the program has not failed.
void refuse_unless_unread(int cause)
{
    if (cause != EPIPE) {
        throw Error(fmt::format("standard output cannot be written: {}", std::strerror(cause != 0 ? cause : EIO)));
    }
    std::clearerr(stdout);
    std::cout.clear();
}

}  // namespace

void say(std::string_view text)
{
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
    static_cast<void>(std::fflush(stderr));
}

void print(std::string_view text)
{
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) refuse_unless_unread(errno);
}

void flush_stdout()
{
    errno = 0;
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    const int cause = errno;
    if (!flushed || std::ferror(stdout) != 0 || !std::cout) refuse_unless_unread(cause);
}

}  // namespace mandelmarch
