// libFuzzer: any bytes as a BMP give a picture, or an InputError.
#include <cstddef>
#include <cstdlib>

#include "core/base/error.h"
#include "core/image/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    try {
        const auto image = mandelmarch::decode_bmp(std::as_bytes(std::span(data, size)), "x");
        if (image.bytes().size() != 3 * image.pixels()) std::abort();
    } catch (const mandelmarch::InputError&) {
    }
    return 0;
}
