// OpenEXR: the colour as displayed, depth, steps and iterations, 32 bits each, as named channels.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/image/formats/formats.h"
#include "core/scene/scene.h"

namespace mandelmarch {
namespace {

// One row of the file.
struct Row {
    explicit Row(int width) : red(width), green(width), blue(width), depth(width), steps(width), iterations(width) {}

    std::vector<float> red, green, blue, depth;
    std::vector<std::uint32_t> steps, iterations;

    // A frame buffer that takes every line of the file for this row.
    Imf::FrameBuffer frame()
    {
        Imf::FrameBuffer buffer;
        const auto add = [&](const char* name, Imf::PixelType type, void* data) {
            buffer.insert(name, Imf::Slice(type, static_cast<char*>(data), 4, 0));
        };
        add("R", Imf::FLOAT, red.data());
        add("G", Imf::FLOAT, green.data());
        add("B", Imf::FLOAT, blue.data());
        add("depth", Imf::FLOAT, depth.data());
        add("steps", Imf::UINT, steps.data());
        add("iterations", Imf::UINT, iterations.data());
        return buffer;
    }
};

void insert_channels(Imf::ChannelList& channels)
{
    for (const char* name : {"R", "G", "B", "depth"}) channels.insert(name, Imf::Channel(Imf::FLOAT));
    for (const char* name : {"steps", "iterations"}) channels.insert(name, Imf::Channel(Imf::UINT));
}

// OpenEXR's output, into an OutputFile that can seek.
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
    Imf::OutputFile output(stream, header, 0);
    Row row(image.width());
    output.setFrameBuffer(row.frame());
    for (int line = 0; line < image.height(); ++line) {
        const int y = image.height() - 1 - line;
        const PixelValue* value = image.values().data() + static_cast<std::size_t>(y) * row.red.size();
        for (std::size_t x = 0; x < row.red.size(); ++x, ++value) {
            row.red[x] = static_cast<float>(value->red);
            row.green[x] = static_cast<float>(value->green);
            row.blue[x] = static_cast<float>(value->blue);
            row.depth[x] = static_cast<float>(value->depth);
            row.steps[x] = static_cast<std::uint32_t>(value->steps);
            row.iterations[x] = static_cast<std::uint32_t>(value->iterations);
        }
        output.writePixels(1);
    }
}

}  // namespace

void write_exr(OutputFile& file, const std::string& path, const Image& image)
{
    if (!image.has_values()) throw Error(path + ": an EXR picture needs an image with all layers");
    try {
        if (!OutputFile::is_stream(path)) {
            FileStream stream(file, path);
            encode(stream, image);
            return;
        }
        // OpenEXR goes back to write its table of rows, which a pipe cannot: the file is made in memory.
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

Image read_exr(const std::string& path)
{
    try {
        Imf::InputFile input(path.c_str(), 0);
        const auto window = input.header().dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        if (width < 1 || width > max_side || height < 1 || height > max_side) {
            throw Error(fmt::format("its size is {} x {} pixels", width, height));
        }
        Image image(static_cast<int>(width), static_cast<int>(height), Image::Layers::all);
        Row row(image.width());
        Imf::FrameBuffer buffer = row.frame();
        for (auto slice = buffer.begin(); slice != buffer.end(); ++slice) {
            slice.slice().base -= 4 * static_cast<std::ptrdiff_t>(window.min.x);
        }
        input.setFrameBuffer(buffer);
        for (int line = 0; line < image.height(); ++line) {
            input.readPixels(window.min.y + line);
            const std::size_t at = static_cast<std::size_t>(image.height() - 1 - line) * row.red.size();
            for (std::size_t x = 0; x < row.red.size(); ++x) {
                image.values()[at + x] = {row.red[x],
                                          row.green[x],
                                          row.blue[x],
                                          row.depth[x],
                                          static_cast<std::int32_t>(row.steps[x]),
                                          static_cast<std::int32_t>(row.iterations[x])};
                const auto byte = [](float c) {
                    return static_cast<std::uint8_t>(c > 0 ? (c < 1 ? 255 * c : 255) : 0);
                };
                image.bytes()[3 * (at + x)] = byte(row.red[x]);
                image.bytes()[3 * (at + x) + 1] = byte(row.green[x]);
                image.bytes()[3 * (at + x) + 2] = byte(row.blue[x]);
            }
        }
        return image;
    } catch (const std::exception& error) {
        throw InputError(fmt::format("{}: {}, expected an EXR picture", path, error.what()));
    }
}

}  // namespace mandelmarch
