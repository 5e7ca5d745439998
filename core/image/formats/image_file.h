// SPDX-License-Identifier: Apache-2.0
// Reads and writes pictures: BMP, PNG, PNM, JPEG and OpenEXR.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/image/image.h"

namespace mandelmarch {

enum class ImageFormat { bmp, png, pnm, jpeg, exr };

// Supported endings, for messages.
inline constexpr std::string_view image_endings = ".bmp, .png, .ppm, .jpg or .exr";

// Returns the format by the ending of the name, in upper or lower case; nullopt if it has none or an unknown one.
std::optional<ImageFormat> image_format(const std::string& path);

// Returns the layers that the format can store.
Image::Layers layers_of(ImageFormat format);

// Throws InputError if the format cannot store a picture of this size (BMP: 4 GiB; JPEG: sides of 65500). width and
// height in pixels.
void check_image_size(ImageFormat format, int width, int height);

// Writes the picture to a complete file or not at all. JPEG is lossy. EXR needs an image with all layers; its channels
// are R, G, B (linear light: the displayed values without the sRGB curve), displayed.R, displayed.G, displayed.B, Z (t,
// +infinity without a hit), steps and iterations. Throws Error with path and cause.
void write_image(const std::string& path, ImageFormat format, const Image& image);

// Reads a picture; its first bytes determine the format. BMP: 24 or 32 bits per pixel, uncompressed, with any masks.
// PNG: any kind, converted to 8 bits per channel, on black if transparent; 16-bit values without a curve in the file
// are displayed values, like 8-bit ones. PNM: grey or colour, as text or bytes. EXR: one part with the channels R, G
// and B, which are linear light; colours come from the layer `displayed` if the file has one. With Z the image has all
// layers (missing steps and iterations are 0), without it Layers::colours. Older files of this program have a channel
// `depth` instead of Z, and displayed values in R, G and B. Rejects files that end early, and, before decoding, headers
// that claim more pixels than the file or the memory can hold. Throws InputError with path and cause.
Image read_image(const std::string& path);

// As read_image, for a file in memory. `name` is used in messages. Throw InputError.
Image decode_bmp(std::span<const std::byte> data, const std::string& name);
Image decode_png(std::span<const std::byte> data, const std::string& name);
Image decode_exr(std::span<const std::byte> data, const std::string& name);
Image decode_pnm(std::span<const std::byte> data, const std::string& name);

}  // namespace mandelmarch
