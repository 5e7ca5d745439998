// SPDX-License-Identifier: Apache-2.0
// Output files of commands are checked before the work, and a failure to write one does not affect the others.
#include "bench/command/outputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.h"
#include "core/base/files.h"

namespace mandelmarch::bench {
namespace {

std::string path_of(const std::string& name)
{
    static const TemporaryFolder folder;
    return (folder.path() / name).string();
}

std::string text_in(const std::string& path)
{
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

Outputs outputs_of(const std::vector<std::pair<std::string, std::string>>& named)
{
    Outputs outputs;
    for (const auto& [option, path] : named) {
        outputs.add(option, path, [name = option] { return "text of " + name; });
    }
    return outputs;
}

TEST(Outputs, AreRefusedBeforeTheWork)
{
    const std::string file = path_of("one.json");
    EXPECT_NO_THROW(outputs_of({{"--json", file}, {"--csv", "-"}, {"--benchmark_out", ""}}).check());
    EXPECT_THROW(outputs_of({{"--json", "/nosuch/x.json"}}).check(), InputError);
    EXPECT_THROW(outputs_of({{"--json", testing::TempDir()}}).check(), InputError);
    EXPECT_THROW(outputs_of({{"--json", "-"}, {"--csv", "-"}}).check(), InputError);
    EXPECT_THROW(outputs_of({{"--json", file}, {"--csv", file}}).check(), InputError);
    EXPECT_THROW(outputs_of({{"--json", file}}).check({file}), InputError) << "the result that is read";
}

TEST(Outputs, KeptResultsAreOfCommittedSources)
{
    namespace fs = std::filesystem;
    const std::string kept = path_of("kept");
    fs::create_directories(kept + "/machine");
    EXPECT_THROW(refuse_kept_result(kept + "/a.json", kept, true), InputError);
    EXPECT_THROW(refuse_kept_result(kept + "/machine/../machine/a.json", kept, true), InputError);
    EXPECT_NO_THROW(refuse_kept_result(kept + "/a.json", kept, false)) << "nothing has changed";
    EXPECT_NO_THROW(refuse_kept_result(kept + "_elsewhere/a.json", kept, true)) << "a folder with a longer name";
}

TEST(Outputs, ALinkToAKeptResultIsOne)
{
    namespace fs = std::filesystem;
    const std::string kept = path_of("kept");
    const std::string link = path_of("link.json");
    fs::create_directories(kept);
    fs::create_symlink(kept + "/a.json", link);
    EXPECT_THROW(refuse_kept_result(link, kept, true), InputError);
}

TEST(Outputs, OneThatFailsCostsTheOthersNothing)
{
    const std::string csv = path_of("kept.csv");
    const Outputs outputs = outputs_of({{"--json", "/dev/full"}, {"--csv", csv}});
    testing::internal::CaptureStderr();
    EXPECT_FALSE(outputs.write_files());
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(text_in(csv), "text of --csv");
    EXPECT_NE(said.find("--json: /dev/full"), std::string::npos) << said;
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    EXPECT_TRUE(outputs_of({{"--csv", csv}}).write_files());
}

}  // namespace
}  // namespace mandelmarch::bench
