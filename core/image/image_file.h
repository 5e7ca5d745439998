// SPDX-License-Identifier: Apache-2.0
// Pictures as files: BMP, PNG, PNM, JPEG and OpenEXR.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/image/image.h"

namespace mandelmarch {

enum class ImageFormat { bmp, png, pnm, jpeg, exr };

// For messages: the endings that image_format() knows.
inline constexpr std::string_view image_endings = ".bmp, .png, .ppm, .jpg or .exr";

// By the name's ending, whatever its case; nullopt where it has none or an unknown one.
std::optional<ImageFormat> image_format(const std::string& path);

// The layers of an image that the format keeps.
Image::Layers layers_of(ImageFormat format);

// Throws InputError if the format cannot hold a picture of this size (BMP: 4 GiB; JPEG: sides of 65500). width and
// height in pixels.
void check_image_size(ImageFormat format, int width, int height);

// Writes the picture, whole or not at all. JPEG loses some of it. EXR needs an image with all layers; its channels are
// R, G, B (light: sRGB's curve is taken off the values as displayed), displayed.R, displayed.G, displayed.B, Z (t,
// +infinity where nothing is hit), steps and iterations. Throws Error with path and cause.
void write_image(const std::string& path, ImageFormat format, const Image& image);

// Reads a picture; the format is told by its first bytes. BMP: 24 or 32 bits a pixel, not compressed, with any masks.
// PNG: any kind, converted to 8 bits a channel, on black where it is transparent; 16 bits without a curve in the file
// are displayed values, like 8 bits. PNM: grey or colour, as text or bytes. EXR: one part with the channels R, G and B,
// which are light; if the file has the layer `displayed`, the colours come from there. With Z the image has all layers
// (missing steps and iterations are 0), without it Layers::colours. Older files of this program have a channel `depth`
// instead of Z, and R, G and B as displayed. A file that ends early is refused, and one whose header claims
// more pixels than the file or the memory can hold is refused before it is decoded. Throws InputError with path and
// cause.
Image read_image(const std::string& path);

// Files in memory, as read_image takes them. `name` is what messages call them. Throw InputError.
Image decode_bmp(std::span<const std::byte> data, const std::string& name);
Image decode_png(std::span<const std::byte> data, const std::string& name);
Image decode_exr(std::span<const std::byte> data, const std::string& name);
Image decode_pnm(std::span<const std::byte> data, const std::string& name);

}  // namespace mandelmarch
