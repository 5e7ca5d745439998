// Pictures as files: BMP, PNG and OpenEXR.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "core/image/image.h"

namespace mandelmarch {

enum class ImageFormat { bmp, png, exr };

// By the name's ending, whatever its case; nullopt where it has none or an unknown one.
std::optional<ImageFormat> image_format(const std::string& path);

// The layers of an image that the format keeps.
Image::Layers layers_of(ImageFormat format);

// Throws InputError if the format cannot hold a picture of this size (BMP: 4 GiB). width and height in pixels.
void check_image_size(ImageFormat format, int width, int height);

// Writes the picture, whole or not at all. EXR needs an image with all layers; its channels are R, G, B (as displayed),
// depth (t, +infinity where nothing is hit), steps and iterations. Throws Error with path and cause.
void write_image(const std::string& path, ImageFormat format, const Image& image);

// Reads a picture; the format is told by its first bytes. BMP: 24 or 32 bits a pixel, not compressed. EXR: the channels
// R, G, B and, where there, depth, steps and iterations. Throws InputError with path and cause.
Image read_image(const std::string& path);

// A BMP file in memory, as read_image takes it. `name` is what messages call it. Throws InputError.
Image decode_bmp(std::span<const std::byte> data, const std::string& name);

}  // namespace mandelmarch
