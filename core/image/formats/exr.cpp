// SPDX-License-Identifier: Apache-2.0
// OpenEXR pictures with 32 bits per channel. R, G and B are linear light, as compositing programs expect. The layer
// `displayed` contains the displayed colours, as floats. Z is the depth. The channels `steps` and `iterations` contain
// these counts.
#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>
#include <ImfXdr.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/image/formats/formats.h"
#include "core/image/formats/image_file.h"
#include "core/image/image.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr std::array exr_colours{"R", "G", "B"};
constexpr std::array exr_displayed{"displayed.R", "displayed.G", "displayed.B"};
constexpr std::array exr_counts{"steps", "iterations"};
constexpr const char* depth_name = "Z";

// Converts a displayed value to linear light by the sRGB curve (IEC 61966-2-1). displayed_of() converts it back.
float light_of(float displayed)
{
    const double c = displayed;
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

float displayed_of(float light)
{
    const double c = light;
    return static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

// The values of one row of the file.
struct Row {
    explicit Row(int width) : depth(width), steps(width), iterations(width)
    {
        for (auto& channel : light) channel.resize(static_cast<std::size_t>(width));
        for (auto& channel : displayed) channel.resize(static_cast<std::size_t>(width));
    }

    std::array<std::vector<float>, 3> light, displayed;
    std::vector<float> depth;
    std::vector<std::uint32_t> steps, iterations;

    // Returns a frame buffer that maps every row of the file to the memory of this object.
    Imf::FrameBuffer frame()
    {
        Imf::FrameBuffer buffer;
        const auto add = [&](const char* name, Imf::PixelType type, void* data) {
            buffer.insert(name, Imf::Slice(type, static_cast<char*>(data), 4, 0));
        };
        for (std::size_t c = 0; c < exr_colours.size(); ++c) {
            add(exr_colours.at(c), Imf::FLOAT, light.at(c).data());
            add(exr_displayed.at(c), Imf::FLOAT, displayed.at(c).data());
        }
        add(depth_name, Imf::FLOAT, depth.data());
        add(exr_counts[0], Imf::UINT, steps.data());
        add(exr_counts[1], Imf::UINT, iterations.data());
        return buffer;
    }
};

void insert_channels(Imf::ChannelList& channels)
{
    for (const auto& names : {exr_colours, exr_displayed}) {
        for (const char* name : names) channels.insert(name, Imf::Channel(Imf::FLOAT));
    }
    channels.insert(depth_name, Imf::Channel(Imf::FLOAT));
    for (const char* name : exr_counts) channels.insert(name, Imf::Channel(Imf::UINT));
}

// An output stream that OpenEXR writes to. Passes the data to an OutputFile, which must be able to seek (see
// OutputFile::is_stream()).
class FileStream : public Imf::OStream {
public:
    FileStream(OutputFile& file, const std::string& path) : Imf::OStream(path.c_str()), file_(file) {}

    void write(const char data[], int size) override
    {
        file_.write(data, static_cast<std::size_t>(size));
        position_ += static_cast<std::uint64_t>(size);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override
    {
        file_.seek(position);
        position_ = position;
    }

private:
    OutputFile& file_;
    std::uint64_t position_ = 0;
};

void encode(Imf::OStream& stream, const Image& image)
{
    Imf::Header header(image.width(), image.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    insert_channels(header.channels());
    // The default chromaticities are those of Rec. 709 and sRGB.
    Imf::addChromaticities(header, Imf::Chromaticities());
    Imf::OutputFile output(stream, header, 0);
    Row row(image.width());
    output.setFrameBuffer(row.frame());
    for (int line = 0; line < image.height(); ++line) {
        const int y = image.height() - 1 - line;
        const PixelValue* value = image.values().data() + static_cast<std::size_t>(y) * row.depth.size();
        for (std::size_t x = 0; x < row.depth.size(); ++x, ++value) {
            const std::array<double, 3> colour{value->red, value->green, value->blue};
            for (std::size_t c = 0; c < colour.size(); ++c) {
                row.displayed.at(c)[x] = static_cast<float>(colour.at(c));
                row.light.at(c)[x] = light_of(row.displayed.at(c)[x]);
            }
            row.depth[x] = static_cast<float>(value->depth);
            row.steps[x] = static_cast<std::uint32_t>(value->steps);
            row.iterations[x] = static_cast<std::uint32_t>(value->iterations);
        }
        output.writePixels(1);
    }
}

// An input stream that OpenEXR reads from. Reads from memory.
class MemoryStream : public Imf::IStream {
public:
    MemoryStream(std::span<const std::byte> data, const std::string& name) : Imf::IStream(name.c_str()), data_(data) {}

    // Returns true if more data follows. Throws if `size` bytes are not available.
    bool read(char to[], int size) override
    {
        if (size < 0 || at_ > data_.size() || data_.size() - at_ < static_cast<std::size_t>(size)) {
            throw Iex::InputExc("the file ends early");
        }
        std::memcpy(to, data_.data() + at_, static_cast<std::size_t>(size));
        at_ += static_cast<std::size_t>(size);
        return at_ < data_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

private:
    std::span<const std::byte> data_;
    std::uint64_t at_ = 0;
};

constexpr int largest_tile = 4096;                // pixels, both sides
constexpr std::uint64_t largest_block = 256;      // lines that are encoded together, in DWAB files
constexpr std::uint64_t usual_block = 640 << 20;  // bytes, enough for the widest picture

constexpr std::size_t first_attribute = 8;  // position in bytes, behind the magic number and the version

// Throws Error if an attribute of the header claims more bytes than the file has. OpenEXR would allocate them.
void check_attributes(std::span<const std::byte> data)
{
    std::size_t at = first_attribute;
    const auto take = [&](std::size_t size) {
        if (size > data.size() - at) throw Error("the file ends in its header");
        at += size;
        return data.subspan(at - size, size);
    };
    const auto skip_text = [&] {
        const std::size_t start = at;
        while (take(1)[0] != std::byte{0}) {
        }
        return at - start > 1;
    };
    while (skip_text()) {  // skips the attribute's name; an empty name ends the header
        skip_text();       // skips the attribute's type
        std::size_t size = 0;
        const auto bytes = take(4);
        for (std::size_t i = bytes.size(); i > 0; --i) size = size << 8 | std::to_integer<std::size_t>(bytes[i - 1]);
        take(size);
    }
}

// Channels of a file. R, G and B always exist.
struct ExrChannels {
    bool depth = false;
    bool displayed = false;  // the layer of displayed colours exists
};

// Checks the file's header before OpenEXR allocates the memory that the header claims. Throws if the header is not
// acceptable. Returns the file's channels.
ExrChannels check_header(std::span<const std::byte> data, const std::string& name)
{
    MemoryStream stream(data, name);
    Imf::Header::setMaxImageSize(max_side, max_side);
    Imf::Header::setMaxTileSize(largest_tile, largest_tile);
    int magic = 0;
    int version = 0;
    Imf::Xdr::read<Imf::StreamIO>(stream, magic);
    Imf::Xdr::read<Imf::StreamIO>(stream, version);
    if (Imf::isMultiPart(version) || Imf::isNonImage(version)) throw Error("it has several parts or deep pixels");
    check_attributes(data);
    Imf::Header header;
    header.readFrom(stream, version);
    header.sanityCheck(Imf::isTiled(version));
    const auto has = [&](const char* channel) { return header.channels().findChannel(channel) != nullptr; };
    for (const char* channel : exr_colours) {
        if (!has(channel)) throw Error(fmt::format("it has no channel {}", channel));
    }
    const ExrChannels found{.depth = has(depth_name), .displayed = std::ranges::all_of(exr_displayed, has)};
    std::uint64_t bytes = 0;  // per pixel
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        bytes += channel.channel().type == Imf::HALF ? 2 : 4;
    }
    const auto window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    // OpenEXR decodes a row of tiles or a block of lines at once.
    const auto lines = Imf::isTiled(version) ? header.tileDescription().ySize : largest_block;
    const std::uint64_t block = static_cast<std::uint64_t>(width) * lines * bytes;
    // A file decodes to at most 2 * deflate_ratio times its size, or with DWA compression to 64 times as much, because
    // one number may then stand for a block of 8 x 8 pixels.
    const auto packing = header.compression();
    const bool dwa = packing == Imf::DWAA_COMPRESSION || packing == Imf::DWAB_COMPRESSION;
    const std::uint64_t most = data.size() * 2 * deflate_ratio * (dwa ? 64 : 1);
    check_claim(name, {.width = width,
                       .height = height,
                       .pixel_bits = 8 * bytes,
                       .most_bytes = most,
                       .decoder = 3 * block,  // encoded, decoded and an intermediate copy
                       .layers = found.depth ? Image::Layers::all : Image::Layers::colours});
    if (block > usual_block + most) throw Error("its lines or tiles are too large for the file");
    return found;
}

// Copies a row of the file to row y of the image, counted from the bottom.
void put_row(const Row& row, const ExrChannels& channels, Image& image, int y)
{
    const std::size_t at = static_cast<std::size_t>(y) * row.depth.size();
    const auto byte = [](float c) { return static_cast<std::uint8_t>(c > 0 ? (c < 1 ? 255 * c : 255) : 0); };
    for (std::size_t x = 0; x < row.depth.size(); ++x) {
        std::array<float, 3> colour{};
        for (std::size_t c = 0; c < colour.size(); ++c) {
            colour.at(c) = channels.displayed ? row.displayed.at(c)[x] : displayed_of(row.light.at(c)[x]);
            image.bytes()[3 * (at + x) + c] = byte(colour.at(c));
        }
        PixelValue& value = image.values()[at + x];
        value.red = colour[0];
        value.green = colour[1];
        value.blue = colour[2];
        if (!channels.depth) continue;
        value.depth = row.depth[x];
        value.steps = static_cast<std::int32_t>(row.steps[x]);
        value.iterations = static_cast<std::int32_t>(row.iterations[x]);
    }
}

}  // namespace

void write_exr(OutputFile& file, const std::string& path, const Image& image)
{
    if (!image.has_depths()) throw Error(path + ": an EXR picture needs an image with all layers");
    try {
        if (!OutputFile::is_stream(path)) {
            FileStream stream(file, path);
            encode(stream, image);
            return;
        }
        // OpenEXR seeks back to write its table of rows. A pipe cannot seek, so the file is built in memory.
        Imf::StdOSStream memory;
        encode(memory, image);
        const std::string data = memory.str();
        file.write(data.data(), data.size());
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(fmt::format("{}: cannot write EXR: {}", path, error.what()));
    }
}

Image decode_exr(std::span<const std::byte> data, const std::string& name)
{
    try {
        const ExrChannels channels = check_header(data, name);
        MemoryStream stream(data, name);
        Imf::InputFile input(stream, 0);
        const auto window = input.header().dataWindow();
        Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1,
                    channels.depth ? Image::Layers::all : Image::Layers::colours);
        Row row(image.width());
        Imf::FrameBuffer buffer = row.frame();
        for (auto slice = buffer.begin(); slice != buffer.end(); ++slice) {
            slice.slice().base -= 4 * static_cast<std::ptrdiff_t>(window.min.x);
        }
        input.setFrameBuffer(buffer);
        for (int line = 0; line < image.height(); ++line) {
            input.readPixels(window.min.y + line);
            put_row(row, channels, image, image.height() - 1 - line);
        }
        return image;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(fmt::format("{}: {}, expected an EXR picture", name, error.what()));
    }
}

}  // namespace mandelmarch
