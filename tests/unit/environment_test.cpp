// SPDX-License-Identifier: Apache-2.0
// Only core/text/environment.cpp reads the environment, through the table of environment.h.
#include "core/text/environment.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/text/error.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

const fs::path source_folder = MANDELMARCH_SOURCE_DIR;

std::string content_of(const fs::path& file)
{
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Environment, IsReadThroughItsTable)
{
    std::vector<fs::path> readers;
    for (const char* folder : {"apps", "backends", "bench", "cli", "core", "flight", "packaging"}) {
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
