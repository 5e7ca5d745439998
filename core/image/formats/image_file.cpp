// SPDX-License-Identifier: Apache-2.0
#include "core/image/formats/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/image/formats/formats.h"
#include "core/image/image.h"

namespace mandelmarch {
namespace {

using Bytes = std::vector<std::byte>;

// Appends up to `size` bytes of the file to `data`. Returns false if the file ended before.
bool read_some(std::ifstream& file, Bytes& data, std::size_t size)
{
    const std::size_t before = data.size();
    data.resize(before + size);
    file.read(reinterpret_cast<char*>(data.data() + before), static_cast<std::streamsize>(size));
    data.resize(before + static_cast<std::size_t>(file.gcount()));
    return data.size() == before + size;
}

bool begins_with(const Bytes& data, std::string_view text)
{
    return data.size() >= text.size() && std::memcmp(data.data(), text.data(), text.size()) == 0;
}

struct KnownEnding {
    std::string_view ending;
    ImageFormat format;
};
constexpr std::array known_endings{KnownEnding{".bmp", ImageFormat::bmp},  KnownEnding{".png", ImageFormat::png},
                                   KnownEnding{".ppm", ImageFormat::pnm},  KnownEnding{".pnm", ImageFormat::pnm},
                                   KnownEnding{".jpg", ImageFormat::jpeg}, KnownEnding{".jpeg", ImageFormat::jpeg},
                                   KnownEnding{".exr", ImageFormat::exr}};

constexpr int largest_jpeg = 65'500;  // libjpeg's max width and height, pixels

bool is_pnm(const Bytes& data)
{
    constexpr std::string_view kinds = "2356";
    return begins_with(data, "P") && data.size() > 2 &&
           kinds.find(std::to_integer<char>(data[1])) != std::string_view::npos &&
           std::isspace(std::to_integer<unsigned char>(data[2])) != 0;
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

void write_image(const std::string& path, ImageFormat format, const Image& image)
{
    OutputFile file(path);
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
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse(path, "it is a directory");
    std::ifstream file(path, std::ios::binary);
    if (!file) refuse(path, std::strerror(errno));
    constexpr std::size_t first = 4;  // number of bytes that determine the format
    Bytes data;
    read_some(file, data, first);
    auto* const decode = begins_with(data, "\x89PNG")            ? decode_png
                         : begins_with(data, "\x76\x2f\x31\x01") ? decode_exr
                         : begins_with(data, "BM")               ? decode_bmp
                         : is_pnm(data)                          ? decode_pnm
                                                                 : nullptr;
    if (decode == nullptr) refuse(path, "it is no BMP, PNG, PNM or EXR");
    const std::uint64_t size = std::filesystem::file_size(path, ignored);
    constexpr std::uint64_t least = 1 << 20;
    const std::size_t step = ignored ? least : std::max(size, least);  // a pipe's size is unknown
    const std::uint64_t most = available_memory();
    do {
        if (step > most || data.size() > most - step) refuse(path, "it is larger than the memory available");
    } while (read_some(file, data, step));
    return decode(data, path);
}

}  // namespace mandelmarch
