// SPDX-License-Identifier: Apache-2.0
// Reads and writes pictures: BMP, PNG, PNM, JPEG and OpenEXR.
//     const ImageFormat format = image_format("a.png").value();
//     write_image("a.png", format, image);  // an image with layers_of(format)
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/image/image.h"
#include "core/os/files.h"

namespace mandelmarch {

enum class ImageFormat { bmp, png, pnm, jpeg, exr };

// The supported endings of file names, for messages.
inline constexpr std::string_view image_endings = ".bmp, .png, .ppm, .jpg or .exr";

// Returns the format that the ending of a file name stands for. The case of letters does not matter. Returns nullopt if
// the name has no ending or an unknown one.
std::optional<ImageFormat> image_format(const std::string& path);

// Returns the layers that the format can store.
Image::Layers layers_of(ImageFormat format);

// Throws InputError if the format cannot store a picture of this width and height, in pixels. BMP files are limited to
// 4 GiB, JPEG sides to 65500 pixels.
void check_image_size(ImageFormat format, int width, int height);

// Writes the picture to a file that appears completely or not at all. JPEG is lossy. EXR needs an image with all
// layers. The channels of an EXR file are R, G and B (linear light: the displayed values without the sRGB curve);
// displayed.R, displayed.G and displayed.B; Z (the depth t, +infinity without a hit); steps; and iterations. Throws
// Error with the path and the cause.
void write_image(const std::string& path, ImageFormat format, const Image& image, NamedBy named = NamedBy::user);

// Reads a picture. Its first bytes determine the format:
// BMP: 24 or 32 bits per pixel, uncompressed, with any masks.
// PNG: any kind, converted to 8 bits per channel. Transparent pixels are put on black. 16-bit values are displayed
// values, like 8-bit ones, unless the file specifies a gamma curve.
// PNM: grey or colour, as text or bytes.
// EXR: a single part with the channels R, G and B, which are linear light; if the layer `displayed` exists, the colours
// come from it. If the file has a channel Z, the image has all layers (steps and iterations are 0 if missing); if not,
// it has Layers::colours.
// Throws InputError, with the path and the cause, for a file that ends early. Also throws, before decoding, if the
// header claims more pixels than the file or the memory can hold.
Image read_image(const std::string& path);

// Decoders, which read_image() uses. Each decodes a file that is in memory, and calls it `name` in messages. Throws
// InputError.
Image decode_bmp(std::span<const std::byte> data, const std::string& name);
Image decode_png(std::span<const std::byte> data, const std::string& name);
Image decode_exr(std::span<const std::byte> data, const std::string& name);
Image decode_pnm(std::span<const std::byte> data, const std::string& name);

}  // namespace mandelmarch
