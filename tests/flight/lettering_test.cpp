// SPDX-License-Identifier: Apache-2.0
// Titles fit into the picture, and use only letters that the font has.

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mandelmarch
