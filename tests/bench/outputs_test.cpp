// SPDX-License-Identifier: Apache-2.0
// Results in the folder of kept results come from committed sources.
#include "bench/command/outputs.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/files.h"

namespace mandelmarch::bench {
namespace {

namespace fs = std::filesystem;

// program_test.sh checks the other rules of outputs.
TEST(Outputs, KeptResultsAreOfCommittedSources)
{
    const TemporaryFolder folder;
    const std::string kept = (folder.path() / "kept").string();
    fs::create_directories(kept + "/machine");
    EXPECT_THROW(refuse_kept_result(kept + "/a.json", kept, true), InputError);
    EXPECT_THROW(refuse_kept_result(kept + "/machine/../machine/a.json", kept, true), InputError);
    EXPECT_NO_THROW(refuse_kept_result(kept + "/a.json", kept, false)) << "nothing has changed";
    EXPECT_NO_THROW(refuse_kept_result(kept + "_elsewhere/a.json", kept, true)) << "a folder with a longer name";
    const std::string link = (folder.path() / "link.json").string();
    fs::create_symlink(kept + "/a.json", link);
    EXPECT_THROW(refuse_kept_result(link, kept, true), InputError) << "a link to a kept result";
}

}  // namespace
}  // namespace mandelmarch::bench
