// SPDX-License-Identifier: Apache-2.0
// PNG through libpng's simplified interface: 8 bits per channel, rows from the top down.
#include <fmt/format.h>
#include <png.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string_view>

#include "core/image/formats/formats.h"
#include "core/image/formats/image_file.h"
#include "core/text/error.h"

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

// Returns the row stride for libpng. It is negative, because libpng begins with the top row and an Image with the
// bottom row.
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
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    const std::unique_ptr<png_image, void (*)(png_image*)> guard(&header, &png_image_free);
    if (png_image_begin_read_from_memory(&header, data.data(), data.size()) == 0) refuse(header.message);
    check_claim(name, {.width = header.width,
                       .height = header.height,
                       .pixel_bits = 1,  // min of all kinds of PNG
                       .most_bytes = data.size() * deflate_ratio,
                       .decoder = 0,
                       .layers = Image::Layers::bytes});
    header.format = PNG_FORMAT_RGB;
    // Without this flag, libpng would interpret 16-bit values as linear light.
    header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    Image image(static_cast<int>(header.width), static_cast<int>(header.height), Image::Layers::bytes);
    const png_color black{};
    if (png_image_finish_read(&header, &black, image.bytes().data(), row_stride(image), nullptr) == 0) {
        refuse(header.message);
    }
    const std::string_view bytes(reinterpret_cast<const char*>(data.data()), data.size());
    constexpr std::string_view end("\0\0\0\0IEND\xae\x42\x60\x82", 12);  // the last chunk, with its checksum
    if (bytes.find(end) != bytes.size() - end.size()) refuse("it does not end where its picture ends");
    return image;
}

}  // namespace mandelmarch
