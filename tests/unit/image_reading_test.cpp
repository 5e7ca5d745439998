// SPDX-License-Identifier: Apache-2.0
// Tests reading picture files that other programs wrote, and damaged files.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/image/compare.h"
#include "core/image/formats/image_file.h"
#include "core/os/files.h"
#include "core/text/error.h"
#include "tests/refusal.h"

namespace mandelmarch {
namespace {

std::string big_endian(std::uint32_t value)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
}

const Bytef* bytes_of(const std::string& text) { return reinterpret_cast<const Bytef*>(text.data()); }

std::string chunk(const std::string& type, const std::string& data)
{
    const std::string both = type + data;
    const auto crc = static_cast<std::uint32_t>(crc32(0, bytes_of(both), static_cast<uInt>(both.size())));
    return big_endian(static_cast<std::uint32_t>(data.size())) + both + big_endian(crc);
}

std::string compressed(const std::string& data)
{
    std::string out(compressBound(data.size()), '\0');
    uLongf size = out.size();
    EXPECT_EQ(compress(reinterpret_cast<Bytef*>(out.data()), &size, bytes_of(data), data.size()), Z_OK);
    return out.substr(0, size);
}

const std::string png_end = chunk("IEND", "");

// Returns a grey PNG of one row, with `bits` per channel. `pixels`: the bytes of the row.
std::string png(std::uint32_t width, std::uint32_t height, int bits, const std::string& pixels)
{
    const std::string header = big_endian(width) + big_endian(height) + static_cast<char>(bits) + std::string(4, '\0');
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", compressed('\0' + pixels)) + png_end;
}

using Decoder = Image (*)(std::span<const std::byte>, const std::string&);

Image decoded(Decoder decode, const std::string& file) { return decode(std::as_bytes(std::span(file)), "x"); }

std::string refusal(Decoder decode, const std::string& file)
{
    return refusal_of([&] { decoded(decode, file); });
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(PngReading, SixteenBitsGiveTheBytesOfEight)
{
    const Image eight = decoded(decode_png, png(3, 1, 8, "\x01\x80\xfe"));
    const Image sixteen = decoded(decode_png, png(3, 1, 16, "\x01\x01\x80\x80\xfe\xfe"));
    EXPECT_EQ(eight.bytes()[3], 0x80);
    EXPECT_TRUE(compare(eight, sixteen).same()) << describe_pixel(eight, sixteen, 1);
}

TEST(PngReading, AFileThatEndsEarlyIsRefused)
{
    const std::string whole = png(3, 1, 8, "abc");
    EXPECT_NO_THROW(decoded(decode_png, whole));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_NE(refusal(decode_png, whole.substr(0, size)), "") << size << " of " << whole.size();
    }
    EXPECT_NE(refusal(decode_png, png(3, 2, 8, "abc")), "");
    EXPECT_TRUE(holds(refusal(decode_png, whole + whole), "does not end where its picture ends"));
}

TEST(PngReading, MorePixelsThanTheFileCanHoldAreRefused)
{
    EXPECT_TRUE(holds(refusal(decode_png, png(65535, 65535, 8, "abc")), "too small a file for 65535 x 65535"));
    EXPECT_TRUE(holds(refusal(decode_png, png(30000, 30000, 1, "abc")), "too small a file for 30000 x 30000"));
    EXPECT_TRUE(holds(refusal(decode_png, png(70000, 1, 8, "abc")), "its size is 70000 x 1"));
}

// Returns an EXR with these channels. Every value is 0.5; in channels of integers it is 5.
std::string exr(const std::vector<std::string>& channels, Imf::Compression compression = Imf::ZIP_COMPRESSION,
                int side = 4)
{
    Imf::Header header(side, side);
    header.compression() = compression;
    std::vector<float> reals(static_cast<std::size_t>(side), 0.5F);
    std::vector<std::uint32_t> wholes(static_cast<std::size_t>(side), 5);
    Imf::FrameBuffer buffer;
    for (const std::string& name : channels) {
        const bool counts = name == "steps" || name == "iterations";
        const Imf::PixelType type = counts ? Imf::UINT : Imf::FLOAT;
        header.channels().insert(name, Imf::Channel(type));
        char* data = counts ? reinterpret_cast<char*>(wholes.data()) : reinterpret_cast<char*>(reals.data());
        buffer.insert(name, Imf::Slice(type, data, 4, 0));
    }
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(side);
    }
    return stream.str();
}

TEST(ExrReading, AMissingColourIsNamed)
{
    EXPECT_NO_THROW(decoded(decode_exr, exr({"R", "G", "B"})));
    EXPECT_TRUE(holds(refusal(decode_exr, exr({"R", "G"})), "no channel B"));
    EXPECT_TRUE(holds(refusal(decode_exr, exr({"B", "G", "Z"})), "no channel R"));
    EXPECT_TRUE(holds(refusal(decode_exr, exr({"Y"})), "no channel R"));
}

TEST(ExrReading, ColoursAloneAreComparedWhereThereIsNoDepth)
{
    const Image flat = decoded(decode_exr, exr({"R", "G", "B"}));
    const Image deep = decoded(decode_exr, exr({"R", "G", "B", "Z"}));
    const Image full = decoded(decode_exr, exr({"R", "G", "B", "Z", "steps", "iterations"}));
    EXPECT_FALSE(flat.has_depths());
    // Linear light of 0.5 is displayed as 187.5 of 255, which reading truncates.
    EXPECT_EQ(flat.bytes()[0], 187);
    EXPECT_EQ(deep.bytes()[0], 187);
    EXPECT_EQ(full.values()[0].steps, 5);
    const Comparison part = compare(flat, full);
    EXPECT_TRUE(part.same() && part.values_compared && !part.depths_compared);
    EXPECT_EQ(describe_pixel(flat, flat, 0).find("depth"), std::string::npos);
    EXPECT_TRUE(compare(deep, full).same() && compare(deep, full).depths_compared);
}

// The channels R, G and B contain linear light, as compositing programs expect. Reading the file gives the displayed
// values, from 0 to 1, back bit for bit.
TEST(ExrWriting, ColoursAreLightAndDepthIsZ)
{
    Image image(3, 1, Image::Layers::all);
    const std::array<float, 3> shown{0.02F, 0.5F, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        PixelValue& value = image.values()[i];
        value.red = value.green = shown[i];
        value.blue = std::nextafter(shown[i], 0.0F);
        value.depth = i == 1 ? INFINITY : 7;
        for (std::size_t c = 0; c < 3; ++c) image.bytes()[3 * i + c] = static_cast<std::uint8_t>(255 * shown[i]);
    }
    const TemporaryFolder folder;
    const std::string name = folder.path() / "light.exr";
    write_image(name, ImageFormat::exr, image);
    const Image back = read_image(name);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(back.values()[i].red, image.values()[i].red);
        EXPECT_EQ(back.values()[i].blue, image.values()[i].blue);
    }
    Imf::InputFile file(name.c_str());
    ASSERT_TRUE(Imf::hasChromaticities(file.header()));
    EXPECT_EQ(Imf::chromaticities(file.header()).red, Imf::Chromaticities().red);
    EXPECT_EQ(file.header().channels().findChannel("depth"), nullptr);
    std::array<float, 3> red{};
    std::array<float, 3> depth{};
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(red.data()), 4, 0));
    buffer.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(depth.data()), 4, 0));
    file.setFrameBuffer(buffer);
    file.readPixels(0);
    EXPECT_NEAR(red[0], 0.02 / 12.92, 1e-8);
    EXPECT_NEAR(red[1], 0.21404114, 1e-7);
    EXPECT_EQ(red[2], 1);
    EXPECT_EQ(depth[0], 7);
    EXPECT_TRUE(std::isinf(depth[1]));
}

// Returns the EXR with (x, y) as the far corner of its data window, the corner with the largest coordinates.
std::string claiming(std::string file, std::int32_t x, std::int32_t y)
{
    const std::string before("dataWindow\0box2i\0\x10\0\0\0", 21);
    const std::size_t at = file.find(before) + before.size() + 8;
    for (int i = 0; i < 4; ++i) {
        file.at(at + static_cast<std::size_t>(i)) = static_cast<char>(x >> (8 * i));
        file.at(at + 4 + static_cast<std::size_t>(i)) = static_cast<char>(y >> (8 * i));
    }
    return file;
}

TEST(ExrReading, MorePixelsThanTheFileCanHoldAreRefused)
{
    for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::DWAB_COMPRESSION}) {
        const std::string file = exr({"R", "G", "B"}, compression);
        EXPECT_NO_THROW(decoded(decode_exr, claiming(file, 3, 3)));
        EXPECT_TRUE(holds(refusal(decode_exr, claiming(file, 65534, 65534)), "too small a file for 65535 x 65535"));
        EXPECT_TRUE(holds(refusal(decode_exr, claiming(file, 1 << 29, 3)), "maximum width"));
        EXPECT_TRUE(holds(refusal(decode_exr, claiming(file, -1, 3)), "expected"));
    }
}

TEST(ExrReading, AHeaderThatClaimsMoreThanTheFileIsRefused)
{
    std::string file = exr({"R", "G", "B"});
    const std::string name("dataWindow\0box2i", 16);
    file.at(file.find(name) + name.size() + 4) = '\x7f';  // the highest byte of the attribute's size
    EXPECT_TRUE(holds(refusal(decode_exr, file), "ends in its header"));
}

// Pictures of one colour compress best. The reader must not refuse them for having many pixels in a small file.
TEST(ExrReading, FlatPicturesOfEveryCompressionAreRead)
{
    for (int kind = Imf::NO_COMPRESSION; kind < Imf::NUM_COMPRESSION_METHODS; ++kind) {
        const std::string file = exr({"R", "G", "B"}, static_cast<Imf::Compression>(kind), 256);
        EXPECT_NO_THROW(decoded(decode_exr, file)) << "compression " << kind << ", " << file.size() << " bytes";
    }
}

TEST(Reading, NothingIsDecodedThatMemoryCannotHold)
{
    const TemporaryFolder folder;
    const std::string path = folder.path() / "large.bmp";
    std::ofstream(path) << "BM";
    std::filesystem::resize_file(path, std::uintmax_t{1} << 43);  // a sparse file
    EXPECT_THROW(read_image(path), InputError);
}

std::string little_endian(std::uint32_t value, int bytes)
{
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
    return text;
}

// Returns a BMP with 32 bits per pixel, these masks and this size of the header. It has two pixels, with the channels
// red, green and blue 1, 2, 3 and 4, 5, 6.
std::string masked_bmp(std::uint32_t red, std::uint32_t green, std::uint32_t blue, std::uint32_t header_bytes)
{
    std::string header = little_endian(header_bytes, 4) + little_endian(2, 4) + little_endian(1, 4) +
                         little_endian(1, 2) + little_endian(32, 2) + little_endian(3, 4);
    header.resize(40, '\0');
    for (const std::uint32_t mask : {red, green, blue, ~(red | green | blue)}) header += little_endian(mask, 4);
    if (header_bytes > header.size()) header.resize(header_bytes, '\0');
    std::string pixels;
    for (std::uint32_t i = 1; i <= 4; i += 3) {
        // Sets all bits outside the three masks, such as those of alpha, to 1.
        pixels += little_endian(~(red | green | blue) | i * (red & (~red + 1)) | (i + 1) * (green & (~green + 1)) |
                                    (i + 2) * (blue & (~blue + 1)),
                                4);
    }
    const auto start = static_cast<std::uint32_t>(14 + header.size());
    return "BM" + little_endian(start + 8, 4) + little_endian(0, 4) + little_endian(start, 4) + header + pixels;
}

TEST(BmpMasks, GiveTheChannelsInAnyOrder)
{
    const std::pmr::vector<std::uint8_t> wanted{1, 2, 3, 4, 5, 6};
    const std::array<std::uint32_t, 4> masks{0xff, 0xff00, 0xff0000, 0xff000000};
    for (const std::uint32_t header : {40U, 52U, 56U, 108U, 124U}) {
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        do {
            const std::string file = masked_bmp(masks[order[0]], masks[order[1]], masks[order[2]], header);
            const Image image = decode_bmp(std::as_bytes(std::span(file)), "memory");
            EXPECT_EQ(image.bytes(), wanted) << header << " " << order[0] << order[1] << order[2];
        } while (std::ranges::next_permutation(order).found);
    }
}

TEST(BmpReading, TopDownPicturesWithoutMasksAreRead)
{
    std::string file = masked_bmp(0xff0000, 0xff00, 0xff, 40);
    file.replace(18, 8, little_endian(1, 4) + little_endian(~1U, 4));  // one column, height -2
    file.replace(30, 4, little_endian(0, 4));                          // no masks
    const Image image = decode_bmp(std::as_bytes(std::span(file)), "memory");
    EXPECT_EQ(image.height(), 2);
    EXPECT_EQ(image.bytes(), (std::pmr::vector<std::uint8_t>{4, 5, 6, 1, 2, 3}));
}

TEST(BmpMasks, OfOtherNumbersOfBitsAreMadeBytes)
{
    const std::string file = masked_bmp(0x3ff00000, 0x000ffc00, 0x000003ff, 40);
    std::string full = file;
    full.replace(full.size() - 8, 4, little_endian(0x3ff001ff, 4));
    const Image image = decode_bmp(std::as_bytes(std::span(full)), "memory");
    EXPECT_EQ(image.bytes()[0], 255);
    EXPECT_EQ(image.bytes()[1], 0);
    EXPECT_EQ(image.bytes()[2], 127);  // from the value 511 of 1023
    for (const std::uint32_t bad : {0U, 0xf0f0U}) {
        const std::string wrong = masked_bmp(bad, 0xff000000, 0xff0000, 40);
        EXPECT_THROW(decode_bmp(std::as_bytes(std::span(wrong)), "memory"), InputError);
    }
    EXPECT_TRUE(holds(refusal(decode_bmp, masked_bmp(0xff, 0x1ff, 0xff0000, 40)), "masks overlap"));
    EXPECT_TRUE(holds(refusal(decode_bmp, file + file), "does not end where its picture ends"));
}

TEST(Pnm, IsReadAsTextAndBytes)
{
    const std::pmr::vector<std::uint8_t> wanted{4, 5, 6, 255, 0, 9, 1, 2, 3, 0, 0, 255};  // begins with the bottom row
    const auto read = [](const std::string& file) {
        return decode_pnm(std::as_bytes(std::span(file)), "memory").bytes();
    };
    EXPECT_EQ(read("P6\n2 2\n255\n" + std::string("\1\2\3\0\0\xff\4\5\6\xff\0\11", 12)), wanted);
    EXPECT_EQ(read("P3 # a comment\n2\t2 #another\n255\n1 2 3 0 0 255\n4 5 6 255 0 9\n"), wanted);
    EXPECT_EQ(read("P5 1 1 65535 " + std::string("\x80\x80", 2)), (std::pmr::vector<std::uint8_t>{128, 128, 128}));
    EXPECT_EQ(read("P5\r\n1 1\r\n255\r\n\7"), (std::pmr::vector<std::uint8_t>{7, 7, 7}));
    EXPECT_EQ(read("P5\r\n1 1\r\n255\r\n"), (std::pmr::vector<std::uint8_t>{10, 10, 10}));
    EXPECT_EQ(read("P2 1 1 100 50"), (std::pmr::vector<std::uint8_t>{128, 128, 128}));
    for (const std::string bad :
         {"P6", "P6 2 2 255 ", "P6 2 2 255 abc", "P3 1 1 255 1 2", "P6 0 2 255 ", "P6 2 2 0 abcdefabcdef",
          "P6 99999 99999 255 a", "P3 1 1 255 1 2 x", "P6 2 2 70000 abcdefabcdef", "P5 1 1 100 e", "P2 1 1 100 101",
          "P5 1 1 255 ab", "P2 1 1 255 7\nP2 1 1 255 7"}) {
        EXPECT_THROW(read(bad), InputError) << bad;
    }
}

}  // namespace
}  // namespace mandelmarch
