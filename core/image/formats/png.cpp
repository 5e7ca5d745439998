// SPDX-License-Identifier: Apache-2.0
// PNG through libpng's simplified interface: 8 bits per channel, rows from the top down.
#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>

#include "core/base/error.h"
#include "core/image/formats/formats.h"
#include "core/image/formats/image_file.h"

namespace mandelmarch {
namespace {

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

struct Sink {
    OutputFile& file;
    std::exception_ptr error;
};

// Writes data from a C stream to the OutputFile. Exceptions must not pass through C code, so the first error is stored.
ssize_t write_to_sink(void* cookie, const char* data, std::size_t size)
{
    auto& sink = *static_cast<Sink*>(cookie);
    try {
        sink.file.write(data, size);
        return static_cast<ssize_t>(size);
    } catch (...) {
        sink.error = std::current_exception();
        return 0;
    }
}

std::uint32_t number(std::span<const std::byte> data, std::size_t at)  // reads a big-endian integer
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(data[at + i]);
    return value;
}

constexpr std::size_t signature_size = 8;
constexpr std::size_t chunk_frame = 12;  // bytes of a chunk in addition to its data: length, type and checksum
constexpr std::uint32_t type_ihdr = 0x49484452, type_idat = 0x49444154, type_iend = 0x49454e44;

// Returns the number of bytes of compressed pixels; nullopt if the file ends before its end chunk.
std::optional<std::uint64_t> compressed_size(std::span<const std::byte> data)
{
    std::uint64_t size = 0;
    for (std::size_t at = signature_size; data.size() - at >= chunk_frame;) {
        const std::uint32_t length = number(data, at);
        const std::uint32_t type = number(data, at + 4);
        if (type == type_iend) return size;
        if (length > data.size() - at - chunk_frame) return std::nullopt;
        if (type == type_idat) size += length;
        at += chunk_frame + length;
    }
    return std::nullopt;
}

// Returns the bits of a pixel, from the header's bits per channel and colour type. Types 0, 2, 3, 4 and 6 have 1, 3, 1
// (an index into the palette), 2 and 4 channels.
std::uint64_t pixel_bits(std::byte depth, std::byte colour)
{
    constexpr std::array<std::uint64_t, 7> channels{1, 0, 3, 1, 2, 0, 4};
    const auto kind = std::to_integer<std::size_t>(colour);
    return std::to_integer<std::uint64_t>(depth) * (kind < channels.size() ? channels.at(kind) : 0);
}

// Returns the distance between rows that libpng uses. It is negative, because libpng begins with the top row, which is
// the last in memory.
png_int_32 row_stride(const Image& image) { return -3 * image.width(); }

}  // namespace

void write_png(OutputFile& file, const std::string& path, const Image& image)
{
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width());
    header.height = static_cast<png_uint_32>(image.height());
    header.format = PNG_FORMAT_RGB;
    Sink sink{file, nullptr};
    const Stream stream(fopencookie(&sink, "wb", {nullptr, write_to_sink, nullptr, nullptr}), &std::fclose);
    if (!stream) throw Error(path + ": cannot open a stream for it");
    const int written =
        png_image_write_to_stdio(&header, stream.get(), 0, image.bytes().data(), row_stride(image), nullptr);
    const bool flushed = std::fflush(stream.get()) == 0;
    if (sink.error) std::rethrow_exception(sink.error);
    if (written == 0 || !flushed) throw Error(fmt::format("{}: cannot write PNG: {}", path, header.message));
}

Image decode_png(std::span<const std::byte> data, const std::string& name)
{
    const auto refuse = [&](const std::string& why) {
        throw InputError(fmt::format("{}: {}, expected a PNG picture", name, why));
    };
    constexpr std::size_t header_at = signature_size + 8;
    constexpr std::size_t header_length = 13;
    if (data.size() < header_at + header_length || number(data, signature_size + 4) != type_ihdr) {
        refuse("it has no header");
    }
    const auto compressed = compressed_size(data);
    if (!compressed) refuse("the file ends early");
    check_claim(name, {.width = number(data, header_at),
                       .height = number(data, header_at + 4),
                       .pixel_bits = pixel_bits(data[header_at + 8], data[header_at + 9]),
                       .most_bytes = *compressed * deflate_ratio,
                       .decoder = 0,
                       .layers = Image::Layers::bytes});
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    const std::unique_ptr<png_image, void (*)(png_image*)> guard(&header, &png_image_free);
    if (png_image_begin_read_from_memory(&header, data.data(), data.size()) == 0) refuse(header.message);
    header.format = PNG_FORMAT_RGB;
    // Without this flag, libpng would interpret 16-bit values as linear light.
    header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    Image image(static_cast<int>(header.width), static_cast<int>(header.height), Image::Layers::bytes);
    const png_color black{};
    if (png_image_finish_read(&header, &black, image.bytes().data(), row_stride(image), nullptr) == 0) {
        refuse(header.message);
    }
    return image;
}

}  // namespace mandelmarch
