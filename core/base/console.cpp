// SPDX-License-Identifier: Apache-2.0
#include "core/base/console.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "core/base/error.h"

namespace mandelmarch {

void say(std::string_view text)
{
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
    static_cast<void>(std::fflush(stderr));
}

void print(std::string_view text)
{
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) flush_stdout();
}

void flush_stdout()
{
    errno = 0;
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    const int cause = errno;
    if (flushed && std::ferror(stdout) == 0 && std::cout) return;
    throw Error(fmt::format("standard output cannot be written: {}", std::strerror(cause != 0 ? cause : EIO)));
}

}  // namespace mandelmarch
