// SPDX-License-Identifier: Apache-2.0
// Common part of the fuzzers for short texts: any bytes are read, or give an InputError of one line.
#pragma once

#include <cstdlib>
#include <string_view>

#include "core/text/error.h"

namespace mandelmarch {

// `begin`: the beginning of every message.
template <class Read>
int fuzz_text(const unsigned char* data, std::size_t size, std::string_view begin, Read read)
{
    try {
        read(std::string_view(reinterpret_cast<const char*>(data), size));
    } catch (const InputError& error) {
        const std::string_view message = error.what();
        if (!message.starts_with(begin) || message.find('\n') != std::string_view::npos || message.size() > 1000) {
            std::abort();
        }
    }
    return 0;
}

}  // namespace mandelmarch
