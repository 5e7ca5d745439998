// SPDX-License-Identifier: Apache-2.0
// Picture formats. Each is implemented in a file of its own; image_file.cpp selects the format.
#pragma once

#include <cstdint>
#include <string>

#include "core/image/image.h"
#include "core/os/output_file.h"

namespace mandelmarch {

// Returns the size in bytes of a 24-bit BMP file of width x height pixels.
std::uint64_t bmp_file_size(int width, int height);

void write_bmp(OutputFile& file, const Image& image);
void write_png(OutputFile& file, const std::string& path, const Image& image);
void write_exr(OutputFile& file, const std::string& path, const Image& image);
void write_pnm(OutputFile& file, const Image& image);
void write_jpeg(OutputFile& file, const std::string& path, const Image& image);

// Max ratio of decoded to encoded size of deflate: two bits encode at most 258 bytes.
inline constexpr std::uint64_t deflate_ratio = 1032;

// Sizes that the header of a file claims.
struct Claim {
    std::int64_t width, height;  // pixels
    std::uint64_t pixel_bits;    // bits per pixel of the decoded data
    std::uint64_t most_bytes;    // max size of the decoded data that a file of this size can contain
    std::uint64_t decoder;       // bytes of memory that the decoder needs in addition to the image
    Image::Layers layers;        // layers of the resulting image
};
// Throws InputError if the claimed size is impossible, the file is too small to contain so many pixels, or the memory
// does not suffice. The message begins with `name`.
void check_claim(const std::string& name, const Claim& claim);

}  // namespace mandelmarch
