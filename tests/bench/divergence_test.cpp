// SPDX-License-Identifier: Apache-2.0
// Code divergence: which lines of a source count, and the mean distance over all pairs of backends.
#include "bench/divergence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "core/base/files.h"

namespace mandelmarch::bench {
namespace {

namespace fs = std::filesystem;

TEST(Divergence, LinesOfCodeAreMoreThanBlanksAndComments)
{
    EXPECT_EQ(lines_of_code("int a;\n\n  // b\nint c; // d\n"), (std::vector{1, 4}));
    EXPECT_EQ(lines_of_code("/* a\nint b;\n*/ int c;\n"), (std::vector{3}));
    EXPECT_EQ(lines_of_code("f(\"// no comment\");\n\"/*\" + a;\nb;"), (std::vector{1, 2, 3}));
    EXPECT_EQ(lines_of_code("\"\\\"/*\";\na;\n"), (std::vector{1, 2}));
    EXPECT_TRUE(lines_of_code("// the end").empty());
}

// Two sets of 4 and 3 lines have two lines in common, of 5 in all: the distance is 1 - 2 / 5.
TEST(Divergence, IsTheMeanOfJaccardsDistances)
{
    const Coverage one{{"a", {1, 2}}, {"b", {1, 2}}};
    const Coverage other{{"a", {1, 2}}, {"c", {7}}};
    EXPECT_DOUBLE_EQ(distance(one, one), 0);
    EXPECT_DOUBLE_EQ(distance(one, other), 1 - 2.0 / 5);
    EXPECT_DOUBLE_EQ(distance(one, {}), 1);
    EXPECT_DOUBLE_EQ(mean_distance({one, other, one}), 2 * (1 - 2.0 / 5) / 3);
    EXPECT_DOUBLE_EQ(mean_distance({one}), 0);
}

// A source tree of two backends, and a reference that does not use the kernel.
class MadeTree : public testing::Test {
protected:
    MadeTree()
    {
        put("core/kernel/text.h", "#include MM_FRACTAL_FILE\nint text;\n");
        put("core/kernel/fractals/one.h", "int fractal;\n");
        put("core/kernel/prelude/left.h", "int left;\n");
        put("core/job/job.h", "int job;\n// a comment\n");
        put("core/job/loops.cpp.in", "int loops;\n");
        put("backends/CMakeLists.txt", "set(backends\n    yardstick\n    left\n    right\n)\n");
        put("backends/yardstick/y.cpp", "int y;\n");
        put("backends/left/l.cpp", "#include \"core/kernel/prelude/left.h\"\n#include \"core/kernel/text.h\"\n");
        put("backends/right/r.cpp", "#include \"core/job/job.h\"\n#include \"core/kernel/text.h\"\n");
        put("backends/right/loops.cpp.in", "int loops;\nint more;\n");
    }

    void put(const std::string& file, const std::string& text) const
    {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
    }

    const TemporaryFolder made_;
    const fs::path& root_ = made_.path();
};

TEST_F(MadeTree, ABackendNeedsItsFolderAndWhatThatNames)
{
    const Divergence found = divergence_of(root_.string());
    ASSERT_EQ(found.models.size(), 2);
    const ModelLines& left = found.models[0];
    const ModelLines& right = found.models[1];
    EXPECT_EQ(left.backend, "left");
    EXPECT_EQ((std::vector{left.own, left.job, left.kernel}), (std::vector{2, 0, 4}));
    // The backend `right` has its own template instead of core/job's.
    EXPECT_EQ((std::vector{right.own, right.job, right.kernel}), (std::vector{4, 1, 3}));
    // The backends need 6 and 8 lines, of which 3 are the same lines: 11 different ones.
    EXPECT_DOUBLE_EQ(found.divergence, 1 - 3.0 / 11);
    EXPECT_DOUBLE_EQ(found.without_one_text, 1);
}

TEST_F(MadeTree, AnotherFolderIsRefused)
{
    fs::remove(root_ / "core/kernel/text.h");
    EXPECT_THROW(divergence_of(root_.string()), InputError);
}

}  // namespace
}  // namespace mandelmarch::bench
