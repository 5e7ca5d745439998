// SPDX-License-Identifier: Apache-2.0
// Fuzzer: any bytes, read as a path file, give a path, or an InputError of one line. The path is unchanged if it is
// written and read again.
#include <cstdlib>

#include "core/text/error.h"
#include "flight/path/path.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    using namespace mandelmarch;
    try {
        const Path path = path_from_text(std::string(reinterpret_cast<const char*>(data), size), "x");
        if (path.frames.empty() || path.scene.iterations < 1) std::abort();
        const std::string text = to_text(path);
        if (to_text(path_from_text(text, "y")) != text) std::abort();
    } catch (const InputError& error) {
        const std::string_view message = error.what();
        if (!message.starts_with("x: ") || message.find('\n') != std::string_view::npos || message.size() > 1000) {
            std::abort();
        }
    }
    return 0;
}
