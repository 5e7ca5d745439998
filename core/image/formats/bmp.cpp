// SPDX-License-Identifier: Apache-2.0
// Windows bitmaps: a file header of 14 bytes, a BITMAPINFOHEADER of 40 bytes, and the rows from the bottom up. A
// pixel's bytes are blue, green, red; each row is padded to a multiple of four bytes. Numbers are little-endian.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <vector>

#include "core/image/formats/formats.h"
#include "core/image/formats/image_file.h"
#include "core/image/image.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr std::size_t header_size = 54;  // bytes of both headers together
constexpr std::size_t file_header_size = 14;
constexpr std::uint32_t info_size = 40;         // bytes
constexpr std::uint32_t dots_per_metre = 2835;  // 72 dots per inch

std::size_t row_size(int width, int bits) { return (static_cast<std::size_t>(width) * bits / 8 + 3) / 4 * 4; }

void put(std::array<std::uint8_t, header_size>& header, std::size_t at, std::uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i) header.at(at + i) = static_cast<std::uint8_t>(value >> (8 * i));
}

std::uint32_t get(std::span<const std::byte> data, std::size_t at, int bytes)
{
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::to_integer<std::uint32_t>(data[at + i]) << (8 * i);
    return value;
}

}  // namespace

std::uint64_t bmp_file_size(int width, int height)
{
    return header_size + static_cast<std::uint64_t>(row_size(width, 24)) * static_cast<std::uint64_t>(height);
}

void write_bmp(OutputFile& file, const Image& image)
{
    std::array<std::uint8_t, header_size> header{'B', 'M'};
    const auto size = static_cast<std::uint32_t>(bmp_file_size(image.width(), image.height()));
    put(header, 2, size, 4);
    put(header, 10, header_size, 4);
    put(header, 14, info_size, 4);
    put(header, 18, static_cast<std::uint32_t>(image.width()), 4);
    put(header, 22, static_cast<std::uint32_t>(image.height()), 4);
    put(header, 26, 1, 2);   // planes
    put(header, 28, 24, 2);  // bits per pixel
    put(header, 34, size - header_size, 4);
    put(header, 38, dots_per_metre, 4);
    put(header, 42, dots_per_metre, 4);
    file.write(header.data(), header.size());

    std::vector<std::uint8_t> row(row_size(image.width(), 24));
    const std::uint8_t* from = image.bytes().data();
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x, from += 3) {
            std::uint8_t* to = row.data() + 3 * static_cast<std::size_t>(x);
            to[0] = from[2];
            to[1] = from[1];
            to[2] = from[0];
        }
        file.write(row.data(), row.size());
    }
}

namespace {

// The bits of a channel in a pixel of three or four bytes.
struct BmpMask {
    int shift = 0;
    std::uint32_t most = 0;  // max value of the channel

    std::uint8_t byte(std::uint32_t pixel) const
    {
        return static_cast<std::uint8_t>((255 * std::uint64_t{pixel >> shift & most} + most / 2) / most);
    }
};

// The layout of a file's pixels, as its headers describe it.
struct BmpPixels {
    int width = 0, height = 0;
    bool top_down = false;
    int bits = 24;
    std::uint32_t start = 0;  // position of the first pixel, in bytes from the beginning of the file
    std::array<BmpMask, 3> masks{BmpMask{16, 255}, BmpMask{8, 255}, BmpMask{0, 255}};  // red, green, blue
};

constexpr std::uint32_t bit_fields = 3, alpha_bit_fields = 6;  // values of `compression`: uncompressed, with masks

template <class Refuse>
BmpMask bmp_mask(std::uint32_t bits, const Refuse& refuse)
{
    if (bits == 0) refuse("a colour's mask is 0");
    const BmpMask mask{std::countr_zero(bits), bits >> std::countr_zero(bits)};
    if ((mask.most & (mask.most + 1)) != 0) refuse("a colour's mask has gaps");
    return mask;
}

template <class Refuse>
BmpPixels read_header(std::span<const std::byte> data, const Refuse& refuse)
{
    if (data.size() < file_header_size + 4) refuse("the file ends in its header");
    if (get(data, 0, 2) != 0x4D42) refuse("it does not begin with BM");
    if (get(data, 14, 4) < info_size) refuse("its header is of an old kind, OS/2's");
    if (data.size() < header_size) refuse("the file ends in its header");
    BmpPixels pixels;
    pixels.start = get(data, 10, 4);
    pixels.width = static_cast<std::int32_t>(get(data, 18, 4));
    const auto height = std::int64_t{static_cast<std::int32_t>(get(data, 22, 4))};
    pixels.top_down = height < 0;
    pixels.bits = static_cast<int>(get(data, 28, 2));
    const std::uint32_t compression = get(data, 30, 4);
    if (pixels.bits != 24 && pixels.bits != 32) refuse(fmt::format("it has {} bits a pixel", pixels.bits));
    const bool masked = pixels.bits == 32 && (compression == bit_fields || compression == alpha_bit_fields);
    if (compression != 0 && !masked) refuse("it is compressed");
    if (pixels.width < 1 || pixels.width > max_side || height == 0 || std::abs(height) > max_side) {
        refuse(fmt::format("its size is {} x {} pixels", pixels.width, std::abs(height)));
    }
    pixels.height = static_cast<int>(std::abs(height));
    // The masks follow the 40-byte BITMAPINFOHEADER; larger headers contain them at the same position.
    constexpr std::size_t masks_size = 12;
    if (masked && data.size() < header_size + masks_size) refuse("the file ends in its header");
    std::uint32_t taken = 0;
    for (std::size_t i = 0; masked && i < pixels.masks.size(); ++i) {
        const std::uint32_t mask = get(data, header_size + 4 * i, 4);
        if ((mask & taken) != 0) refuse("its colours' masks overlap");
        taken |= mask;
        pixels.masks.at(i) = bmp_mask(mask, refuse);
    }
    return pixels;
}

}  // namespace

Image decode_bmp(std::span<const std::byte> data, const std::string& name)
{
    const auto refuse = [&](const std::string& why) {
        throw InputError(fmt::format("{}: {}, expected an uncompressed 24 or 32 bit BMP", name, why));
    };
    const BmpPixels pixels = read_header(data, refuse);
    const auto rows = static_cast<std::size_t>(pixels.height);
    const std::size_t stride = row_size(pixels.width, pixels.bits);
    if (pixels.start < header_size || pixels.start > data.size() || (data.size() - pixels.start) / stride < rows) {
        refuse("the file ends in its pixels");
    }
    // The header has the size of the file, which may have a colour profile behind its pixels. Some programs write 0.
    const std::size_t end = std::max<std::size_t>(get(data, 2, 4), pixels.start + stride * rows);
    if (end < data.size()) refuse("it does not end where its picture ends");
    Image image(pixels.width, pixels.height, Image::Layers::bytes);
    std::uint8_t* to = image.bytes().data();
    const int bytes = pixels.bits / 8;
    for (std::size_t y = 0; y < rows; ++y) {
        std::size_t at = pixels.start + (pixels.top_down ? rows - 1 - y : y) * stride;
        for (int x = 0; x < pixels.width; ++x, at += static_cast<std::size_t>(bytes)) {
            const std::uint32_t pixel = get(data, at, bytes);
            for (const BmpMask& mask : pixels.masks) *to++ = mask.byte(pixel);
        }
    }
    return image;
}

}  // namespace mandelmarch
