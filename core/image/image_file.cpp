#include "core/image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/image/formats/formats.h"

namespace mandelmarch {
namespace {

std::vector<std::byte> contents(std::ifstream& file)
{
    file.seekg(0, std::ios::end);
    const auto size = file.tellg();
    file.seekg(0);
    std::vector<std::byte> data(size > 0 ? static_cast<std::size_t>(size) : 0);
    file.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size()));
    data.resize(static_cast<std::size_t>(file.gcount()));
    return data;
}

}  // namespace

std::optional<ImageFormat> image_format(const std::string& path)
{
    std::string ending = std::filesystem::path(path).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending == ".bmp") return ImageFormat::bmp;
    if (ending == ".png") return ImageFormat::png;
    if (ending == ".exr") return ImageFormat::exr;
    return std::nullopt;
}

Image::Layers layers_of(ImageFormat format)
{
    return format == ImageFormat::exr ? Image::Layers::all : Image::Layers::bytes;
}

void check_image_size(ImageFormat format, int width, int height)
{
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
        case ImageFormat::exr: write_exr(file, path, image); break;
    }
    file.commit();
}

Image read_image(const std::string& path)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(path + ": it is a directory, expected a picture");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(fmt::format("{}: {}, expected a picture", path, std::strerror(errno)));
    std::array<char, 4> magic{};
    file.read(magic.data(), magic.size());
    const std::string_view first(magic.data(), static_cast<std::size_t>(file.gcount()));
    if (first.starts_with("\x89PNG")) return read_png(path);
    if (first.starts_with("\x76\x2f\x31\x01")) return read_exr(path);
    if (!first.starts_with("BM")) throw InputError(path + ": it is no BMP, PNG or EXR, expected a picture");
    file.clear();
    return decode_bmp(contents(file), path);
}

}  // namespace mandelmarch
