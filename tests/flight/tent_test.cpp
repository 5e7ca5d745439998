// SPDX-License-Identifier: Apache-2.0
// The filter that softens films with one sample per pixel.
#include <gtest/gtest.h>

#include <algorithm>

#include "flight/film/shrink.h"

namespace mandelmarch {
namespace {

Image black(int width, int height) { return {width, height, Image::Layers::bytes}; }

// Row 0 of an image is its bottom row; the filtered picture begins with the top row.
TEST(Softened, TakesATenthOfEachNeighbour)
{
    Image picture = black(3, 3);
    picture.bytes()[3 * 4 + 1] = 200;  // green in the middle
    for (const int threads : {1, 3}) {
        const auto rgb = softened(picture, threads);
        const std::vector<int> green{0, 20, 0, 20, 120, 20, 0, 20, 0};
        for (std::size_t i = 0; i < green.size(); ++i) {
            EXPECT_EQ(rgb[3 * i + 1], green[i]) << i;
            EXPECT_EQ(rgb[3 * i], 0);
        }
    }
    // The bottom row is the last one of the result: top and bottom are not exchanged.
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
