// SPDX-License-Identifier: Apache-2.0
// One file per picture format; image_file.cpp chooses.
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

// Deflate's best: 258 bytes for two bits.
inline constexpr std::uint64_t deflate_ratio = 1032;

// Throws InputError, which begins with `name`, where a file's header claims a size that no picture has, more pixels
// than can be packed into the file, or more memory than there is.
struct Claim {
    std::int64_t width, height;  // pixels
    std::uint64_t pixel_bits;    // of the unpacked data
    std::uint64_t most_bytes;    // that the file's data can unpack to
    std::uint64_t decoder;       // bytes of memory that the decoder needs
    Image::Layers layers;        // of the image that is made
};
void check_claim(const std::string& name, const Claim& claim);

}  // namespace mandelmarch
