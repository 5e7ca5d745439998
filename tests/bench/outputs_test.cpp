// SPDX-License-Identifier: Apache-2.0
// The project's folder of kept results receives results of committed sources only. program_test.sh tests the outputs.
#include "bench/command/outputs.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files.h"

namespace mandelmarch::bench {
namespace {

TEST(Outputs, KeptResultsAreOfCommittedSources)
{
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const std::string kept = (folder.path() / "kept").string();
    const std::string link = (folder.path() / "link.json").string();
    fs::create_directories(kept + "/machine");
    fs::create_symlink(kept + "/a.json", link);
    for (const std::string& path : {kept + "/a.json", kept + "/machine/../machine/a.json", link}) {
        EXPECT_THROW(refuse_kept_result(path, kept, true), InputError) << path;
        EXPECT_NO_THROW(refuse_kept_result(path, kept, false)) << "nothing has changed";
    }
    EXPECT_NO_THROW(refuse_kept_result(kept + "_elsewhere/a.json", kept, true)) << "a folder with a longer name";
}

}  // namespace
}  // namespace mandelmarch::bench
