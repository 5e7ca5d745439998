// SPDX-License-Identifier: Apache-2.0
#include "core/image/formats/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <limits>
#include <string_view>

#include "core/image/formats/formats.h"
#include "core/image/image.h"
#include "core/os/input_file.h"
#include "core/os/memory.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

struct KnownEnding {
    std::string_view ending;
    ImageFormat format;
};
constexpr std::array known_endings{KnownEnding{".bmp", ImageFormat::bmp},  KnownEnding{".png", ImageFormat::png},
                                   KnownEnding{".ppm", ImageFormat::pnm},  KnownEnding{".pnm", ImageFormat::pnm},
                                   KnownEnding{".jpg", ImageFormat::jpeg}, KnownEnding{".jpeg", ImageFormat::jpeg},
                                   KnownEnding{".exr", ImageFormat::exr}};

constexpr int largest_jpeg = 65'500;  // libjpeg's max width and height, pixels

bool is_pnm(std::string_view data)
{
    constexpr std::string_view kinds = "2356";
    return data.starts_with("P") && data.size() > 2 && kinds.find(data[1]) != std::string_view::npos &&
           std::isspace(static_cast<unsigned char>(data[2])) != 0;
}

[[noreturn]] void refuse(const std::string& name, const std::string& why)
{
    throw InputError(fmt::format("{}: {}, expected a picture", name, why));
}

}  // namespace

std::optional<ImageFormat> image_format(const std::string& path)
{
    std::string ending = std::filesystem::path(path).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto* const known = std::ranges::find(known_endings, ending, &KnownEnding::ending);
    return known != known_endings.end() ? std::optional(known->format) : std::nullopt;
}

Image::Layers layers_of(ImageFormat format)
{
    return format == ImageFormat::exr ? Image::Layers::all : Image::Layers::bytes;
}

void check_image_size(ImageFormat format, int width, int height)
{
    if (format == ImageFormat::jpeg && std::max(width, height) > largest_jpeg) {
        throw InputError(
            fmt::format("a JPEG of {} x {} pixels, expected sides up to {}, or PNG", width, height, largest_jpeg));
    }
    const std::uint64_t size = bmp_file_size(width, height);
    if (format != ImageFormat::bmp || size <= std::numeric_limits<std::uint32_t>::max()) return;
    throw InputError(fmt::format(
        "a BMP of {} x {} pixels would have {} bytes and the format ends at 4 GiB, expected a smaller size, PNG or EXR",
        width, height, size));
}

void write_image(const std::string& path, ImageFormat format, const Image& image, NamedBy named)
{
    OutputFile file(path, named);
    switch (format) {
        case ImageFormat::bmp: write_bmp(file, image); break;
        case ImageFormat::png: write_png(file, path, image); break;
        case ImageFormat::pnm: write_pnm(file, image); break;
        case ImageFormat::jpeg: write_jpeg(file, path, image); break;
        case ImageFormat::exr: write_exr(file, path, image); break;
    }
    file.commit();
}

void check_claim(const std::string& name, const Claim& claim)
{
    const std::string size = fmt::format("{} x {} pixels", claim.width, claim.height);
    if (claim.width < 1 || claim.width > max_side || claim.height < 1 || claim.height > max_side) {
        refuse(name, "its size is " + size);
    }
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(claim.width) * static_cast<std::uint64_t>(claim.height);  // below 2^32
    if (pixels * claim.pixel_bits / 8 > claim.most_bytes) refuse(name, "it is too small a file for " + size);
    const std::uint64_t needed = pixels * Image::bytes_per_pixel(claim.layers) + claim.decoder;
    if (const std::string lack = memory_shortage(size, needed); !lack.empty()) refuse(name, lack);
}

Image read_image(const std::string& path)
{
    InputFile file(path, "picture");
    constexpr std::size_t first = 4;  // number of bytes that determine the format
    std::string data;
    file.append(data, first);
    auto* const decode = data.starts_with("\x89PNG")            ? decode_png
                         : data.starts_with("\x76\x2f\x31\x01") ? decode_exr
                         : data.starts_with("BM")               ? decode_bmp
                         : is_pnm(data)                         ? decode_pnm
                                                                : nullptr;
    if (decode == nullptr) file.refuse("it is no BMP, PNG, PNM or EXR");
    file.append(data, std::numeric_limits<std::size_t>::max());
    return decode(std::as_bytes(std::span(data)), path);
}

}  // namespace mandelmarch
