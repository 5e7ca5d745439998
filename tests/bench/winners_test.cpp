// SPDX-License-Identifier: Apache-2.0
// The last lines of a study's output, which name the winners, for synthetic results with a known winner.
#include "bench/judge/winners.h"

#include <gtest/gtest.h>

#include <string>

#include "bench/files/result_file.h"
#include "bench/print/printers.h"
#include "made.h"

namespace mandelmarch::bench {
namespace {

// Returns a row with times of about `seconds`. The speeds of its runs scatter by the fraction `spread`.
Row raced(const std::string& backend, double seconds, double spread, int runs = 5)
{
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        for (int round = 0; round < 6; ++round) times.push_back(seconds * (1 + spread * (run % 3 - 1)));
    }
    return made_row(backend, times, 6);
}

std::string last_lines(std::vector<Row> rows, int runs = 5) { return winners(made_result(std::move(rows), runs)); }

TEST(Winners, TheFastestWinsByItsRatioAndForCertain)
{
    const std::string text =
        last_lines({raced("opencl", 0.25, 0.01), raced("openmp", 0.1, 0.002), raced("vulkan", 0.3, 0.01)});
    EXPECT_NE(text.find("mandelbox float exact: openmp won, 2.4"), std::string::npos) << text;
    EXPECT_NE(text.find(" times as fast as opencl ["), std::string::npos) << text;
    EXPECT_NE(text.find(", the next of 2, p "), std::string::npos) << text;
    EXPECT_NE(text.find("for 2 comparisons\n"), std::string::npos) << text;
}

// Negative controls: there is no winner if the runs contradict each other, or if the lead is within the margin.
TEST(Winners, AnUncertainLeadIsUndecided)
{
    const std::string text = last_lines({raced("opencl", 0.105, 0.1), raced("openmp", 0.1, 0.002)});
    EXPECT_NE(text.find("openmp leads, 1.0"), std::string::npos) << text;
    EXPECT_NE(text.find("]: undecided, more runs would tell\n"), std::string::npos) << text;
}

TEST(Winners, WithinTheMarginIsTheSame)
{
    const std::string text = last_lines({raced("stdpar", 0.1005, 0.002), raced("openmp", 0.1, 0.002)});
    EXPECT_NE(text.find("openmp leads, 1.005 times as fast as stdpar ["), std::string::npos) << text;
    EXPECT_NE(text.find("]: the same within 2 %\n"), std::string::npos) << text;
}

TEST(Winners, FewPicturesProveNothing)
{
    const std::string text = last_lines({made_row("stdpar", {0.2, 0.2}), made_row("openmp", {0.1, 0.1})}, 1);
    EXPECT_NE(text.find("openmp leads, 2.000 times as fast as stdpar: too few pictures to be certain\n"),
              std::string::npos)
        << text;
}

// A single run is judged by the medians of groups of rounds, as in compare.
TEST(Winners, OneRunIsJudgedByGroupsOfRounds)
{
    const auto found = json_of(made_result({raced("stdpar", 0.2, 0, 1), raced("openmp", 0.1, 0, 1)}))["winners"];
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["fastest"], "mandelbox/float/exact/openmp/0");
    EXPECT_EQ(found[0]["rivals"][0]["verdict"], "SLOWER");
    EXPECT_NEAR(found[0]["rivals"][0]["ratio"], 2, 1e-12);
}

TEST(Winners, TheScalarTextIsARivalAndTheReferenceIsNone)
{
    Row scalar = raced("openmp", 1, 0.002);
    scalar.sweep_value = "simd-width=1";
    scalar.setting.simd_width = 1;
    const std::string text = last_lines({raced("openmp", 0.1, 0.002), scalar, raced("reference", 0.01, 0.002)});
    EXPECT_NE(text.find("openmp won, 10.00 times as fast as openmp-scalar ["), std::string::npos) << text;
    EXPECT_EQ(text.find("reference"), std::string::npos) << text;
}

TEST(Winners, EachFractalPrecisionAndModeHasALine)
{
    std::vector<Row> rows;
    for (const char* fractal : {"mandelbulb", "mandelbox"}) {
        for (const Precision precision : {Precision::f64, Precision::f32}) {
            for (const char* backend : {"openmp", "opencl"}) {
                rows.push_back(raced(backend, 0.1, 0.01));
                rows.back().fractal = fractal;
                rows.back().precision = precision;
            }
        }
    }
    EXPECT_EQ(contests_of(made_result(rows, 5)).size(), 4U);
}

TEST(Winners, TheLastLineSaysHowManyProcessorsWereFree)
{
    Result result = made_result({raced("openmp", 0.1, 0.01, 1)});
    result.environment["cpu"]["cores_usable"] = 8;
    result.environment["during"] = {{"others_share", 0.25}, {"stolen_share", 0.125}};
    EXPECT_TRUE(
        to_console(result, false)
            .ends_with("mandelbox float exact: openmp alone was timed\n"
                       "5.0 of 8 processors were free: other programs took 25 % of their time, the hypervisor 12 %\n"))
        << to_console(result, false);
}

}  // namespace
}  // namespace mandelmarch::bench
