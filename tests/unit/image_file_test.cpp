// SPDX-License-Identifier: Apache-2.0
// Picture files can be read after they are written, and appear complete or not at all.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <vector>

// jpeglib.h must be included after cstdio, whose declarations it uses.
#include <jpeglib.h>

#include "core/image/averaged.h"
#include "core/image/compare.h"
#include "core/image/formats/image_file.h"
#include "core/os/files.h"
#include "core/os/output_file.h"
#include "core/text/error.h"
#include "tests/refusal.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder / name).string(); }

    static Image noise(int width, int height)
    {
        Image image(width, height, Image::Layers::all);
        std::mt19937 random(static_cast<unsigned>(width * 1000 + height));
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            PixelValue& v = image.values()[i];
            for (double* c : {&v.red, &v.green, &v.blue}) *c = static_cast<float>(random() % 1000) / 1000.0F;
            v.depth = i % 5 == 0 ? INFINITY : static_cast<float>(random() % 1000);
            v.steps = static_cast<std::int32_t>(random() % 8000);
            v.iterations = static_cast<std::int32_t>(random() % 80'000'000);
            std::uint8_t* byte = image.bytes().data() + 3 * i;
            for (const double c : {v.red, v.green, v.blue})
                *byte++ = static_cast<std::uint8_t>(255 * static_cast<float>(c));
        }
        return image;
    }

    const TemporaryFolder made;
    const fs::path folder = made.path();
};

TEST_F(Files, EveryFormatComesBack)
{
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {3, 2}, {5, 4}, {33, 17}, {64, 64}}) {
        const Image image = noise(width, height);
        for (const char* name : {"a.bmp", "a.png", "a.ppm", "a.pnm", "a.exr"}) {
            write_image(path(name), *image_format(name), image);
            const Image back = read_image(path(name));
            EXPECT_EQ(back.bytes(), image.bytes()) << name << " " << width;
            if (back.has_values()) {
                const Comparison c = compare(image, back);
                EXPECT_TRUE(c.values_compared && c.same()) << describe_pixel(image, back, c.first);
                EXPECT_EQ(back.values().back().iterations, image.values().back().iterations);
                EXPECT_EQ(back.values().back().steps, image.values().back().steps);
            }
        }
    }
}

// Returns the bytes of the picture that libjpeg decodes from a file, beginning with the top row.
std::vector<std::uint8_t> decoded_jpeg(const std::string& file, unsigned& width, unsigned& height)
{
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_decompress(&info);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
    jpeg_stdio_src(&info, stream.get());
    jpeg_read_header(&info, TRUE);
    jpeg_start_decompress(&info);
    width = info.output_width;
    height = info.output_height;
    std::vector<std::uint8_t> rgb(3ULL * width * height);
    while (info.output_scanline < height) {
        JSAMPLE* row = rgb.data() + 3ULL * info.output_scanline * width;
        jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_destroy_decompress(&info);
    return rgb;
}

TEST_F(Files, JpegsAreThePictureUpToItsLoss)
{
    Image image(40, 24, Image::Layers::bytes);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 40; ++x) {
            std::uint8_t* pixel = image.bytes().data() + 3 * (static_cast<std::ptrdiff_t>(y) * 40 + x);
            pixel[0] = static_cast<std::uint8_t>(6 * x);
            pixel[1] = static_cast<std::uint8_t>(10 * y);
            pixel[2] = static_cast<std::uint8_t>(255 - 6 * x);
        }
    }
    write_image(path("a.jpg"), ImageFormat::jpeg, image);
    unsigned width = 0;
    unsigned height = 0;
    const auto rgb = decoded_jpeg(path("a.jpg"), width, height);
    ASSERT_EQ(width, 40U);
    ASSERT_EQ(height, 24U);
    for (int y = 0; y < 24; ++y) {
        for (int i = 0; i < 120; ++i) {
            const int wanted = image.bytes()[static_cast<std::size_t>((23 - y) * 120 + i)];
            ASSERT_NEAR(rgb[static_cast<std::size_t>(y * 120 + i)], wanted, 10) << y << " " << i;
        }
    }
    EXPECT_THROW(check_image_size(ImageFormat::jpeg, 65535, 10), InputError);
}

TEST_F(Files, BmpRowsArePaddedToFourBytes)
{
    for (int width = 1; width <= 9; ++width) {
        write_image(path("a.bmp"), ImageFormat::bmp, noise(width, 3));
        EXPECT_EQ(fs::file_size(path("a.bmp")), 54U + 3U * ((3U * static_cast<unsigned>(width) + 3U) / 4U * 4U));
    }
}

TEST_F(Files, OldFileStaysWhereWritingFails)
{
    write_image(path("a.bmp"), ImageFormat::bmp, noise(8, 8));
    const auto size = fs::file_size(path("a.bmp"));
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const rlimit small{4096, old.rlim_max};
    for (const char* name : {"a.bmp", "b.bmp", "b.png", "b.exr", "b.jpg"}) {
        setrlimit(RLIMIT_FSIZE, &small);
        EXPECT_THROW(write_image(path(name), *image_format(name), noise(200, 200)), Error) << name;
        setrlimit(RLIMIT_FSIZE, &old);
        EXPECT_EQ(files_in(folder).size(), 1U) << name << " left something";
    }
    EXPECT_EQ(fs::file_size(path("a.bmp")), size);
}

TEST_F(Files, UnwritableTargetsAreRefused)
{
    EXPECT_THROW(OutputFile::check(""), InputError);
    EXPECT_THROW(OutputFile::check(path(std::string(300, 'a') + ".bmp")), InputError);
    EXPECT_NO_THROW(OutputFile::check(path("a.bmp")));
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Averaged, PixelsAreMeansOfTheirSamples)
{
    Image samples(4, 2, Image::Layers::all);
    for (std::size_t i = 0; i < samples.pixels(); ++i) {
        samples.bytes()[3 * i] = static_cast<std::uint8_t>(i);
        PixelValue& value = samples.values()[i];
        value.red = static_cast<double>(i);
        value.depth = i == 5 ? 2 : INFINITY;
        value.iterations = 2'000'000'000;
    }
    const Image image = averaged(samples, 2);
    ASSERT_EQ(image.width(), 2);
    ASSERT_EQ(image.height(), 1);
    EXPECT_EQ(image.bytes()[0], 3);  // the mean of 0, 1, 4, 5 is 2.5
    EXPECT_EQ(image.bytes()[3], 5);
    EXPECT_EQ(image.values()[0].red, 2.5);
    EXPECT_EQ(image.values()[0].depth, 2);
    EXPECT_TRUE(std::isinf(image.values()[1].depth));
    EXPECT_EQ(image.values()[1].iterations, 2'000'000'000);
}

TEST(Formats, FollowTheEndingOfTheName)
{
    EXPECT_EQ(image_format("a.BMP"), ImageFormat::bmp);
    EXPECT_EQ(image_format("x/y.exr"), ImageFormat::exr);
    EXPECT_EQ(image_format("noending"), std::nullopt);
    EXPECT_EQ(image_format("a.Jpeg"), ImageFormat::jpeg);
    EXPECT_EQ(image_format("a.ppm"), ImageFormat::pnm);
    EXPECT_EQ(image_format("a.tiff"), std::nullopt);
}

}  // namespace
}  // namespace mandelmarch
