// SPDX-License-Identifier: Apache-2.0
// Picture formats, one file each; image_file.cpp selects the format.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/output_file.h"
#include "core/image/image.h"

namespace mandelmarch {

// Size in bytes of a 24-bit BMP file; width and height in pixels.
std::uint64_t bmp_file_size(int width, int height);

void write_bmp(OutputFile& file, const Image& image);
void write_png(OutputFile& file, const std::string& path, const Image& image);
void write_exr(OutputFile& file, const std::string& path, const Image& image);
void write_pnm(OutputFile& file, const Image& image);
void write_jpeg(OutputFile& file, const std::string& path, const Image& image);

// Max ratio of deflate: 258 bytes from two bits.
inline constexpr std::uint64_t deflate_ratio = 1032;

// Sizes that a file's header claims.
struct Claim {
    std::int64_t width, height;  // pixels
    std::uint64_t pixel_bits;    // of the decoded data
    std::uint64_t most_bytes;    // max size of the file's decoded data
    std::uint64_t decoder;       // bytes of memory for the decoder
    Image::Layers layers;        // of the resulting image
};
// Throws InputError, with a message that begins with `name`, if the size is impossible, the file cannot contain so many
// pixels, or the memory does not suffice.
void check_claim(const std::string& name, const Claim& claim);

}  // namespace mandelmarch
