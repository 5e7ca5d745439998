// SPDX-License-Identifier: Apache-2.0
// The samples of a study's runs are merged. Some runs may leave no result.
#include "bench/measure/runs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/result/figures.h"
#include "core/text/error.h"
#include "made.h"

namespace mandelmarch::bench {
namespace {

Result of_run(int run)
{
    Result result = made_result({made_row("openmp", {0.1, 0.2}), made_row("opencl", {0.3, 0.4})});
    for (Row& row : result.rows) {
        for (Sample& sample : row.samples) sample.run = run;
    }
    result.peaks.push_back({"machine", "openmp", 0, Precision::f64, 100.0 + run});
    result.warnings.emplace_back("noise");
    return result;
}

TEST(ValuesByRun, AreMergedByRow)
{
    const Result all = with_further_runs(of_run(0), 3, [](int run) {
        Result result = of_run(run);
        if (run == 1) result.rows[1].failure = "died";
        return result;
    });
    EXPECT_EQ(all.runs, 3);
    EXPECT_EQ(all.warnings, (std::vector<std::string>{"noise", "run 1: noise", "run 2: noise"}));
    EXPECT_EQ(run_medians(all.rows[0]).size(), 3U);
    EXPECT_EQ(all.rows[0].samples.size(), 6U);
    ASSERT_EQ(all.peaks.size(), 1U);
    EXPECT_EQ(all.peaks[0].rate, 102);
    EXPECT_TRUE(all.rows[1].failed());
    EXPECT_FALSE(all.rows[1].timed());
}

TEST(ValuesByRun, OneThatLeavesNothingCostsTheOthersNothing)
{
    testing::internal::CaptureStderr();
    const Result all = with_further_runs(of_run(0), 4, [](int run) {
        if (run == 2) throw Error("ended with 137");
        return of_run(run);
    });
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(all.runs, 3);
    EXPECT_EQ(run_medians(all.rows[0]).size(), 3U);
    EXPECT_EQ(all.rows[0].samples.back().run, 3);
    EXPECT_NE(std::ranges::find(all.warnings, "run 2 ended with 137"), all.warnings.end());
    EXPECT_NE(said.find("run 2 ended with 137"), std::string::npos) << said;
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
}

TEST(ValuesByRun, TheFirstIsKeptWhereAllOthersFail)
{
    testing::internal::CaptureStderr();
    const Result all = with_further_runs(of_run(0), 3, [](int) -> Result { throw Error("ended with 1"); });
    testing::internal::GetCapturedStderr();
    EXPECT_EQ(all.runs, 1);
    EXPECT_EQ(all.rows[0].samples.size(), 2U);
}

}  // namespace
}  // namespace mandelmarch::bench
