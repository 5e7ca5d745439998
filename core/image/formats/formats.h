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

Image read_png(const std::string& path);
Image read_exr(const std::string& path);

}  // namespace mandelmarch
