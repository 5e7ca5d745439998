// SPDX-License-Identifier: Apache-2.0
// Tests the values that parameter files may have. Any other value gives an error of one line, with the place and the
// fault.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "tests/refusal.h"

namespace mandelmarch {
namespace {

using Lines = std::vector<std::string>;

const Lines bulb_lines{"1.2 .26 .2", "0 0 0", "0 1 0", "2.0", "40 30", "-3.0",
                       "0 4.0 8.0",  "100 0", "1",     "1.2", "a.bmp"};
const Lines box_lines{"14 8 10", "0 0 0", "0 1 0", "1.1", "40 30", "-4", "2 0.5 1", "18 100", "1", "1.2", "a.bmp"};

std::string joined(const Lines& lines, const std::string& end = "\n")
{
    std::string text;
    for (const auto& line : lines) text += line + end;
    return text;
}

Lines with(Lines lines, std::size_t number, const std::string& text)
{
    lines.at(number - 1) = text;
    return lines;
}

Scene parse(const std::string& text, const char* fractal = "bulb")
{
    return parse_parameters(text, "x.dat", fractal_named(fractal)).scene;
}

// Returns the message of the InputError for `text`; empty if it is accepted.
std::string refusal(const std::string& text, const char* fractal)
{
    return refusal_of([&] { parse(text, fractal); });
}

struct BadLine {
    const char* fractal;
    int number;
    const char* text;
};

void PrintTo(const BadLine& bad, std::ostream* out)
{
    *out << bad.fractal << ", line " << bad.number << ": " << bad.text;
}

const std::string no_colouring = std::to_string(colouring_types);

class Refused : public testing::TestWithParam<BadLine> {};

TEST_P(Refused, WithFileAndLine)
{
    const auto& [fractal, number, text] = GetParam();
    const Lines& good = std::string(fractal) == "bulb" ? bulb_lines : box_lines;
    const std::string message = refusal(joined(with(good, static_cast<std::size_t>(number), text)), fractal);
    EXPECT_TRUE(message.starts_with("x.dat:" + std::to_string(number) + ": ")) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Lines, Refused,
    testing::Values(BadLine{"bulb", 1, "one two three"}, BadLine{"bulb", 1, "1 2"}, BadLine{"bulb", 1, "1 2 3 4"},
                    BadLine{"bulb", 1, "nan 0 0"}, BadLine{"bulb", 1, "inf 0 0"}, BadLine{"bulb", 1, "1e400 0 0"},
                    BadLine{"bulb", 1, "0x1 0 0"}, BadLine{"bulb", 1, "1e300 0 0"}, BadLine{"bulb", 2, "1.2 .26 .2"},
                    BadLine{"bulb", 3, "0 0 0"}, BadLine{"bulb", 3, "1.2 .26 .2"}, BadLine{"bulb", 4, "0"},
                    BadLine{"bulb", 4, "-1"}, BadLine{"bulb", 4, "2.7693"}, BadLine{"bulb", 4, "3"},
                    BadLine{"bulb", 5, "0 30"}, BadLine{"bulb", 5, "-40 30"}, BadLine{"bulb", 5, "40.5 30"},
                    BadLine{"bulb", 5, "0x28 30"}, BadLine{"bulb", 5, "65536 30"}, BadLine{"bulb", 5, "40"},
                    BadLine{"bulb", 5, "99999999999999999999 3"}, BadLine{"bulb", 6, "-60"}, BadLine{"bulb", 6, "-1e9"},
                    BadLine{"bulb", 6, "99"}, BadLine{"bulb", 7, "0 -4 8"}, BadLine{"bulb", 7, "0 0 8"},
                    BadLine{"bulb", 7, "0 4 0"}, BadLine{"bulb", 7, "0 4 -8"}, BadLine{"bulb", 7, "4 8"},
                    BadLine{"bulb", 7, "0 4 1e-60"}, BadLine{"bulb", 8, "0 0"}, BadLine{"bulb", 8, "1000000000 0"},
                    BadLine{"bulb", 8, "1.5 0"}, BadLine{"bulb", 9, no_colouring.c_str()}, BadLine{"bulb", 9, "-1"},
                    BadLine{"bulb", 9, "red"}, BadLine{"bulb", 10, "-1"}, BadLine{"bulb", 10, "nan"},
                    BadLine{"box", 7, "0 0.5 1"}, BadLine{"box", 7, "1 0.5 1"}, BadLine{"box", 7, "2 0 1"},
                    BadLine{"box", 7, "2 0.5 0"}, BadLine{"box", 7, "2 1e-30 1"}, BadLine{"box", 8, "18 0"},
                    BadLine{"box", 8, "18 -1"}, BadLine{"box", 8, "18"}, BadLine{"bulb", 11, "12"}));

TEST(ParameterFile, ConstantsThatOverflowAreRefused)
{
    Lines lines = with(box_lines, 7, "0.5 0.5 1");
    EXPECT_EQ(refusal(joined(lines), "box"), "");
    lines = with(lines, 8, "9000 100");
    EXPECT_TRUE(refusal(joined(lines), "box").starts_with("x.dat:8: "));
}

TEST(ParameterFile, EveryTruncationIsRefused)
{
    Lines lines = bulb_lines;
    while (!lines.empty()) {
        lines.pop_back();
        const std::string message = refusal(joined(lines), "bulb");
        EXPECT_TRUE(std::regex_search(message, std::regex("^x\\.dat:[0-9]+: the file ends, expected"))) << message;
    }
}

TEST(ParameterFile, JunkIsRefusedInOneLine)
{
    const std::string junk("\x7f\x45LF\0\1\2\xff\xfe\n\n\0", 12);
    for (const std::string& text :
         {junk, std::string(1'000'000, '7'), std::string(500'000, 'x') + "\n", joined(bulb_lines) + "more\n",
          joined(with(bulb_lines, 4, std::string("1\0", 2)))}) {
        const std::string message = refusal(text, "bulb");
        EXPECT_TRUE(message.starts_with("x.dat:")) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
        EXPECT_LT(message.size(), 300U);
    }
}

TEST(ParameterFile, FormsThatAreAccepted)
{
    const std::string plain = joined(bulb_lines);
    Lines commented = bulb_lines;
    for (auto& line : commented) line = "\t  " + line + "\t # why\n# a comment\n\n   ";
    for (const std::string& text : {plain, "\xEF\xBB\xBF" + plain, joined(bulb_lines, "\r\n"), joined(commented),
                                    plain.substr(0, plain.size() - 1), plain + "# the end"}) {
        const Scene scene = parse(text);
        EXPECT_EQ(scene.eye.y, 0.26);
        EXPECT_EQ(scene.width, 40);
        EXPECT_EQ(scene.shape[2], 8);
        EXPECT_EQ(scene.image_file, "a.bmp");
    }
    EXPECT_EQ(parse(joined(with(bulb_lines, 11, "a name with # and spaces.png"))).image_file, "a name with");
    EXPECT_EQ(parse(joined(with(bulb_lines, 11, "a#1.png"))).image_file, "a#1.png");
}

TEST(ParameterFile, RealsOfTheOriginalAreSingle)
{
    const Scene scene = parse(joined(with(with(bulb_lines, 10, "1.2"), 6, "-3.3")));
    EXPECT_EQ(scene.brightness, static_cast<double>(1.2F));
    EXPECT_EQ(scene.detail, static_cast<double>(-3.3F));
    EXPECT_EQ(scene.eye.x, 1.2);
}

TEST(ParameterFile, OldVariantWithSuperSamplingIsWarnedOf)
{
    Lines lines = with(bulb_lines, 11, "4");
    lines.push_back("old.bmp");
    const ParameterFile file = parse_parameters(joined(lines), "x.dat", fractal_named("bulb"));
    EXPECT_EQ(file.scene.image_file, "old.bmp");
    ASSERT_EQ(file.warnings.size(), 1U);
    EXPECT_TRUE(file.warnings[0].starts_with("x.dat:11: warning: ")) << file.warnings[0];
}

// The official file of a fractal gives no warning, with or without its comments. The file of another fractal gives one.
TEST(ParameterFile, AnotherFractalsFileIsWarnedOf)
{
    const std::string_view box = fractal_named("box").official;
    std::string bare;
    std::istringstream lines{std::string(box)};
    for (std::string line; std::getline(lines, line);) bare += line.starts_with('#') ? "" : line + "\n";
    for (const std::string& text : {std::string(box), bare}) {
        EXPECT_TRUE(parse_parameters(text, "x.dat", fractal_named("box")).warnings.empty());
        const ParameterFile mixed = parse_parameters(text, "x.dat", fractal_named("bulb"));
        ASSERT_EQ(mixed.warnings.size(), 1U);
        EXPECT_NE(mixed.warnings[0].find("suit a mandelbox better than a mandelbulb"), std::string::npos);
    }
    const std::string low_power = joined(with(bulb_lines, 7, "0 2 2.5"));
    EXPECT_TRUE(parse_parameters(low_power, "x.dat", fractal_named("bulb")).warnings.empty());
    const std::string other = refusal(std::string(fractal_named("bulb").official), "box");
    EXPECT_NE(other.find("reads as one of a mandelbulb"), std::string::npos) << other;
}

}  // namespace
}  // namespace mandelmarch
