// SPDX-License-Identifier: Apache-2.0
// The pictures of a film: their titles, the pixels that are computed from samples, and the sun.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "flight/film/frames.h"
#include "flight/film/title.h"
#include "tests/refusal.h"

namespace mandelmarch {
namespace {

class Letters : public testing::Test {
protected:
    Lettering fitted(const std::string& text, int wanted, double width, double height = 1000)
    {
        const Lettering found = lettering(font, "--title", text, wanted, width, height);
        for (const std::string& line : found.lines) EXPECT_LE(font.width(line) * found.size, width) << line;
        EXPECT_LE(line_height * found.size * static_cast<double>(found.lines.size()), height);
        return found;
    }

    std::string refusal(const std::string& text, double width = 1000)
    {
        return refusal_of([&] { lettering(font, "--title", text, 32, width, 1000); });
    }

    Font font{title_font()};
};

TEST_F(Letters, AShortTextHasTheGivenSize)
{
    const Lettering found = fitted("Bulb", 32, 1000);
    EXPECT_EQ(found.size, 32);
    EXPECT_EQ(found.lines, std::vector<std::string>{"Bulb"});
}

TEST_F(Letters, ALongerTextHasSmallerOnes)
{
    const Lettering found = fitted("The Flight through the Mandelbulb", 32, 500);
    EXPECT_LT(found.size, 32);
    EXPECT_EQ(found.lines.size(), 1U);
    EXPECT_GT(font.width(found.lines[0]) * (found.size + 1), 500);  // the next size does not fit
}

TEST_F(Letters, AVeryLongTextIsBrokenInTwo)
{
    const Lettering found = fitted("The Flight through the Mandelbulb of Order Eight", 32, 320);
    ASSERT_EQ(found.lines.size(), 2U);
    EXPECT_EQ(found.lines[0] + " " + found.lines[1], "The Flight through the Mandelbulb of Order Eight");
}

TEST_F(Letters, LinesStayAsTheyAre)
{
    const Lettering found = fitted("one\ntwo words\r\nthree", 32, 1000, 60);
    EXPECT_EQ(found.lines, (std::vector<std::string>{"one", "two words", "three"}));
    EXPECT_LT(found.size, 32);
}

TEST_F(Letters, ThoseThatTheFontLacksAreNamed)
{
    EXPECT_EQ(refusal("Übung – Σ Ж"), "");
    const std::string said = refusal("\u5206a\u5f62\u5206");
    EXPECT_NE(said.find("--title: the font "), std::string::npos) << said;
    EXPECT_NE(said.find(" lacks \u5206 (U+5206), \u5f62 (U+5F62), expected"), std::string::npos) << said;
    EXPECT_NE(refusal("a\x1b[31m").find("lacks U+001B"), std::string::npos);
    EXPECT_NE(refusal("\U00020BB7").find("U+20BB7"), std::string::npos);
}

TEST_F(Letters, TextThatIsNoUtf8IsRefused)
{
    for (const char* bad : {"a\xff", "a\xc3", "\xc0\xaf", "\x80"}) {
        EXPECT_NE(refusal(bad).find("not valid UTF-8"), std::string::npos);
    }
}

TEST_F(Letters, NoneAreTooSmallToRead)
{
    EXPECT_NE(refusal(std::string(300, 'm')).find("expected a shorter one"), std::string::npos);
    EXPECT_EQ(refusal(std::string(100, 'i'), 400), "");
}

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

constexpr int frames = 1800;  // a minute

// Returns a flight over the pole y of a fractal. Its gaze turns by 90 degrees.
Path turning(const std::string& fractal = "bulb")
{
    Path path;
    path.scene = official_scene(fractal_named(fractal), 16, 9);
    for (int i = 0; i < frames; ++i) {
        const double angle = std::numbers::pi / 2 * i / frames;
        const Vector eye{0, 3, 0};
        path.frames.push_back({eye, eye + Vector{std::sin(angle), 0, std::cos(angle)}, {0, 1, 0}, 1, {}});
    }
    return path;
}

// Returns a flight around a Mandelbulb, with the fractal below.
Path rounding()
{
    Path path = turning();
    for (Frame& frame : path.frames) {
        const double angle = 3 * std::asin(frame.target.x);
        const Vector up{std::sin(angle), std::cos(angle), 0};
        frame = {3.0 * up, 3.0 * up + cross({0, 0, 1}, up), up, 1, {}};
    }
    return path;
}

Sky sky_in(const Path& path, std::size_t frame, const std::string& more = "")
{
    Picture picture;
    picture.look = {.colouring = 2, .values = parse_look("exposure 1\nsun_height 30\n" + more, "a.look")};
    return FrameScenes(path, picture).scene(frame).sky;
}

double degrees_between(Vector a, Vector b) { return std::acos(std::min(1.0, dot(a, b))) * 180 / std::numbers::pi; }

TEST(Sun, TurnsWithTheWayOnlyIfTheLookRequiresIt)
{
    const Path path = turning();
    EXPECT_EQ(sky_in(path, 0), sky_in(path, frames - 1));
    EXPECT_GT(degrees_between(sky_in(path, 0, "sun_azimuth 110").sun, sky_in(path, frames - 1, "sun_azimuth 110").sun),
              30);
}

TEST(Sun, IsAtTheHeightOfTheLook)
{
    for (const char* const more : {"", "sun_azimuth 110"}) {
        const Sky sky = sky_in(rounding(), 900, more);
        EXPECT_NEAR(dot(sky.sun, sky.up), 0.5, 1e-12);
        EXPECT_NEAR(length(sky.sun), 1, 1e-12);
    }
}

TEST(Sun, MovesSmoothlyAndStaysBesideTheGaze)
{
    const Path path = turning();
    Vector before = sky_in(path, 0, "sun_azimuth 110").sun;
    for (std::size_t frame = 1; frame < frames; ++frame) {
        const Vector sun = sky_in(path, frame, "sun_azimuth 110").sun;
        EXPECT_LT(degrees_between(sun, before), 0.2) << frame;
        const Vector gaze = path.frames[frame].target - path.frames[frame].eye;
        EXPECT_NEAR(degrees_between(unit(Vector{sun.x, 0, sun.z}), gaze), 110, 20) << frame;
        EXPECT_GT(dot(sun, cross(gaze, {0, 1, 0})), 0.5) << frame;  // on the right
        before = sun;
    }
}

TEST(Sky, TurnsSlowlyAfterTheUpOfALevelCamera)
{
    Path jumping = turning("box");
    for (std::size_t i = frames / 2; i < frames; ++i) jumping.frames[i].up = {0, -1, 0};
    for (const auto& [path, up] : {std::pair{rounding(), unit(rounding().frames.back().eye)}, {jumping, {0, -1, 0}}}) {
        const std::vector<Sky> skies = skies_of(path);
        EXPECT_LT(degrees_between(skies.back().up, up), 5);
        for (std::size_t i = 1; i < frames; ++i) {
            EXPECT_LT(degrees_between(skies[i].up, skies[i - 1].up), 0.26) << i;
            EXPECT_LT(degrees_between(skies[i].north, skies[i - 1].north), 0.26) << i;
        }
    }
}

}  // namespace
}  // namespace mandelmarch
