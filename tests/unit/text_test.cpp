// SPDX-License-Identifier: Apache-2.0
// Tests control characters in printed text, and the depth of JSON.
#include "core/text/text.h"

#include <gtest/gtest.h>

#include "core/text/error.h"

namespace mandelmarch {
namespace {

TEST(Printable, IsOneLineWithoutControlCharacters)
{
    EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
    EXPECT_EQ(printable("\x1b[31m\x07\x7f"), "\\x1b[31m\\x07\\x7f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Printable, KeepsUtf8AndEscapesOtherBytes)
{
    EXPECT_EQ(printable("H\u00fclle \u2260 \U0001f600"), "H\u00fclle \u2260 \U0001f600");
    EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");
    EXPECT_EQ(printable("\xc2\x9b!"), "\\xc2\\x9b!") << "a control character of eight bits";
}

TEST(Printable, LongTextIsCut)
{
    EXPECT_EQ(printable("abcdef", 3), "abc...");
    EXPECT_EQ(printable("abc", 3), "abc");
    EXPECT_LT(printable(std::string(5'000'000, '\n')).size(), longest_message + 10);
}

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

TEST(JsonDepth, IsLimited)
{
    EXPECT_NO_THROW(check_json_depth(nested(deepest_json), "x"));
    EXPECT_THROW(check_json_depth(nested(deepest_json + 1), "x"), InputError);
    EXPECT_THROW(check_json_depth(std::string(300'000, '{'), "x"), InputError);
}

TEST(JsonDepth, DoesNotCountSiblingsOrTexts)
{
    std::string siblings;
    for (int i = 0; i < 1000; ++i) siblings += "[{}],";
    EXPECT_NO_THROW(check_json_depth(siblings, "x"));
    EXPECT_NO_THROW(check_json_depth('"' + std::string(1000, '[') + '"', "x"));
    EXPECT_NO_THROW(check_json_depth("\"\\\"" + std::string(1000, '[') + '"', "x"));
    EXPECT_THROW(check_json_depth("\"\\\\\"" + std::string(1000, '['), "x"), InputError);
}

}  // namespace
}  // namespace mandelmarch
