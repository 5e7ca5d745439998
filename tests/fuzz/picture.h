// SPDX-License-Identifier: Apache-2.0
// Common part of the fuzzers for picture files: any bytes, read as a picture file, give a complete picture, or an
// InputError.
#pragma once

#include <cstddef>
#include <cstdlib>

#include "core/text/error.h"
#include "core/image/formats/image_file.h"

namespace mandelmarch {

using Decoder = Image (*)(std::span<const std::byte> data, const std::string& name);

inline int fuzz_picture(Decoder decode, const unsigned char* data, std::size_t size)
{
    try {
        const Image image = decode(std::as_bytes(std::span(data, size)), "x");
        if (image.pixels() == 0 || image.bytes().size() != 3 * image.pixels()) std::abort();
        if (image.has_values() && image.values().size() != image.pixels()) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}

}  // namespace mandelmarch
