// SPDX-License-Identifier: Apache-2.0
// Tests how a film's pictures are made from samples: a mean over each pixel, and a filter for one sample per pixel.
#include <gtest/gtest.h>

#include <algorithm>

#include "flight/film/frames.h"

namespace mandelmarch {
namespace {

Image black(int width, int height) { return {width, height, Image::Layers::bytes}; }

// The picture has 3 x 3 samples for 2 x 2 pixels. A pixel is one and a half samples wide, and pixels share the samples
// in the middle. Row 0 of an image is its bottom row.
TEST(Shrunk, IsTheMeanOverAPixelsArea)
{
    Image picture(3, 3, Image::Layers::bytes);
    for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t c = 0; c < 3; ++c) picture.bytes()[3 * i + c] = static_cast<std::uint8_t>(10 * i + 80 * c);
    }
    // In each direction, the three samples have the weights 2/3 1/3 0 in the first pixel and 0 1/3 2/3 in the second.
    // The red samples are, from the bottom, 0 10 20 / 30 40 50 / 60 70 80.
    const std::vector<std::uint8_t> red{53, 67, 13, 27};
    for (const int threads : {1, 3}) {
        const auto rgb = shrunk(picture, 2, 2, threads);
        ASSERT_EQ(rgb.size(), 12U);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(rgb[3 * i], red[i]);
            EXPECT_EQ(rgb[3 * i + 2], red[i] + 160);
        }
    }
    EXPECT_EQ(shrunk(picture, 1, 1, 1)[0], 40);
    EXPECT_EQ(shrunk(picture, 3, 3, 1)[6], 80);
}

TEST(Shrunk, LeavesALargeEvenPictureEven)
{
    for (const auto& [width, height] : {std::pair{1919, 7}, {640, 1081}, {97, 13}}) {
        Image picture(width, height, Image::Layers::bytes);
        std::ranges::fill(picture.bytes(), 255);
        for (const std::uint8_t byte : shrunk(picture, width * 2 / 3, height - 5, 2)) ASSERT_EQ(byte, 255);
    }
}

// Row 0 of an image is its bottom row, but the filtered picture begins with the top row.
TEST(Softened, TakesATenthOfEachNeighbour)
{
    Image picture = black(3, 3);
    picture.bytes()[3 * 4 + 1] = 200;  // the green byte of the middle pixel
    for (const int threads : {1, 3}) {
        const auto rgb = softened(picture, threads);
        const std::vector<int> green{0, 20, 0, 20, 120, 20, 0, 20, 0};
        for (std::size_t i = 0; i < green.size(); ++i) {
            EXPECT_EQ(rgb[3 * i + 1], green[i]) << i;
            EXPECT_EQ(rgb[3 * i], 0);
        }
    }
    // The image's bottom row must be the result's last row.
    Image bottom = black(1, 2);
    bottom.bytes()[0] = 100;
    EXPECT_EQ(softened(bottom, 1), (std::vector<std::uint8_t>{10, 0, 0, 90, 0, 0}));
}

TEST(Softened, LeavesAnEvenPictureEven)
{
    for (int value = 0; value < 256; ++value) {
        Image picture = black(5, 4);
        std::ranges::fill(picture.bytes(), static_cast<std::uint8_t>(value));
        for (const std::uint8_t byte : softened(picture, 2)) ASSERT_EQ(byte, value);
    }
}

}  // namespace
}  // namespace mandelmarch
