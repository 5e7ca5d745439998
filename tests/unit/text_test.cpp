// SPDX-License-Identifier: Apache-2.0
// Control characters in printed text, the depth of JSON, and variables of the environment.
#include "core/text/text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/text/environment.h"
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

namespace fs = std::filesystem;

std::string content_of(const fs::path& file)
{
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Only core/text/environment.cpp reads the environment, through the table of environment.h.
TEST(Environment, IsReadThroughItsTable)
{
    const fs::path source_folder = MANDELMARCH_SOURCE_DIR;
    std::vector<fs::path> readers;
    for (const char* folder : {"apps", "backends", "bench", "core", "flight", "packaging"}) {
        for (const auto& entry : fs::recursive_directory_iterator(source_folder / folder)) {
            if (entry.is_regular_file() && content_of(entry).find("getenv(") != std::string::npos) {
                readers.push_back(fs::relative(entry, source_folder));
            }
        }
    }
    EXPECT_EQ(readers, std::vector<fs::path>{"core/text/environment.cpp"});
}

TEST(Environment, SecondsAreANumberInTheirRange)
{
    const char* const name = "MANDELMARCH_FFMPEG_TIMEOUT";
    for (const char* wrong : {"abc", "-5", "nan", "0", "5s", "1e7"}) {
        setenv(name, wrong, 1);
        EXPECT_THROW(environment_seconds("MANDELMARCH_FFMPEG_TIMEOUT", 30), InputError) << wrong;
    }
    setenv(name, "2.5", 1);
    EXPECT_EQ(environment_seconds("MANDELMARCH_FFMPEG_TIMEOUT", 30), 2.5);
    unsetenv(name);
    EXPECT_EQ(environment_seconds("MANDELMARCH_FFMPEG_TIMEOUT", 30), 30);
}

TEST(Environment, HelpNamesAProgramsOwnVariables)
{
    EXPECT_NE(environment_help("flythrough").find("\n  MANDELMARCH_FONT: font file of the title"), std::string::npos);
    EXPECT_EQ(environment_help("render").find("MANDELMARCH_FONT"), std::string::npos);
}

}  // namespace
}  // namespace mandelmarch
