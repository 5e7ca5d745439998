// SPDX-License-Identifier: Apache-2.0
// Windows bitmaps: a 14-byte file header, a 40-byte BITMAPINFOHEADER, rows from the bottom up, blue first, each row
// padded to a multiple of four bytes. Numbers are little-endian.
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <vector>

#include "core/base/error.h"
#include "core/image/formats/formats.h"
#include "core/image/image_file.h"
#include "core/scene/scene.h"

namespace mandelmarch {
namespace {

constexpr std::size_t header_size = 54;         // bytes, both headers
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

Image decode_bmp(std::span<const std::byte> data, const std::string& name)
{
    const auto refuse = [&](const std::string& why) {
        throw InputError(fmt::format("{}: {}, expected an uncompressed 24 or 32 bit BMP", name, why));
    };
    if (data.size() < header_size) refuse("the file ends in its header");
    if (get(data, 0, 2) != 0x4D42) refuse("it does not begin with BM");
    if (get(data, 14, 4) < info_size) refuse("its header is of an old kind");
    const std::uint32_t start = get(data, 10, 4);
    const auto width = static_cast<std::int32_t>(get(data, 18, 4));
    const auto signed_height = static_cast<std::int32_t>(get(data, 22, 4));
    const auto bits = static_cast<int>(get(data, 28, 2));
    const std::uint32_t compression = get(data, 30, 4);
    if (bits != 24 && bits != 32) refuse(fmt::format("it has {} bits a pixel", bits));
    // 3 is "bit fields", the usual way to write 32 bits; the masks are taken to be blue, green, red.
    if (compression != 0 && !(compression == 3 && bits == 32)) refuse("it is compressed");
    const bool top_down = signed_height < 0;  // a negative height: rows from the top down
    const std::int64_t height = top_down ? -static_cast<std::int64_t>(signed_height) : signed_height;
    if (width < 1 || width > max_side || height < 1 || height > max_side) {
        refuse(fmt::format("its size is {} x {} pixels", width, height));
    }
    const std::size_t stride = row_size(width, bits);
    if (start < header_size || start > data.size() ||
        (data.size() - start) / stride < static_cast<std::size_t>(height)) {
        refuse("the file ends in its pixels");
    }
    Image image(width, static_cast<int>(height), Image::Layers::bytes);
    std::uint8_t* to = image.bytes().data();
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        const std::size_t row = top_down ? static_cast<std::size_t>(height) - 1 - y : y;
        const std::byte* from = data.data() + start + row * stride;
        for (int x = 0; x < width; ++x, from += bits / 8, to += 3) {
            to[0] = std::to_integer<std::uint8_t>(from[2]);
            to[1] = std::to_integer<std::uint8_t>(from[1]);
            to[2] = std::to_integer<std::uint8_t>(from[0]);
        }
    }
    return image;
}

}  // namespace mandelmarch
