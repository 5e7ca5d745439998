// SPDX-License-Identifier: Apache-2.0
// Names of files: which names refer to the same file, and that a command uses no file for two purposes.
#include "core/base/files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

class FileNames : public testing::Test {
protected:
    FileNames()
    {
        fs::create_directories(folder / "inner");
        std::ofstream(folder / "there") << "text";
        std::ofstream(folder / "other") << "text";
    }

    std::string path(const std::string& name) const { return (folder / name).string(); }

    const TemporaryFolder made;
    const fs::path folder = made.path();
};

TEST_F(FileNames, OneFileHasManyNames)
{
    fs::create_symlink("there", path("link"));
    fs::create_hard_link(path("there"), path("hard"));
    for (const char* name : {"there", "inner/../there", "link", "hard"}) {
        EXPECT_TRUE(same_file(path("there"), path(name))) << name;
    }
    EXPECT_FALSE(same_file(path("there"), path("other")));
    EXPECT_FALSE(same_file(path("there"), path("missing")));
}

TEST_F(FileNames, SoHasAFileThatIsNotThereYet)
{
    fs::create_symlink("missing", path("dangling"));
    fs::create_directory_symlink("inner", path("door"));
    EXPECT_TRUE(same_file(path("missing"), path("./inner/../missing")));
    EXPECT_TRUE(same_file(path("missing"), path("dangling")));
    EXPECT_TRUE(same_file(path("inner/new"), path("door/new")));
    EXPECT_FALSE(same_file(path("inner/new"), path("new")));
    EXPECT_FALSE(same_file(path("new"), path("newer")));
}

TEST_F(FileNames, LinksInACircleAreRefused)
{
    fs::create_symlink("b", path("a"));
    fs::create_symlink("a", path("b"));
    EXPECT_THROW(end_of_links(path("a")), InputError);
}

TEST_F(FileNames, NothingWrittenIsAnotherFile)
{
    EXPECT_THROW(refuse_shared_files({{"--output", path("new")}, {"--stats", path("new")}}), InputError);
    EXPECT_THROW(refuse_shared_files({{"--output", path("there")}}, {{"PARAMS", path("./there")}}), InputError);
    EXPECT_NO_THROW(refuse_shared_files({{"--map", path("new")}}, {{"A", path("there")}, {"B", path("there")}}));
    EXPECT_NO_THROW(refuse_shared_files({{"--output", path("new")}, {"--stats", ""}, {"--json", ""}}));
    EXPECT_NO_THROW(refuse_shared_files({{"--output", "/dev/null"}, {"--stats", "/dev/null"}}));
}

}  // namespace
}  // namespace mandelmarch
