// SPDX-License-Identifier: Apache-2.0
// The last lines of a study's output name the winners. Here the results are synthetic, with known winners.
#include "bench/result/winners.h"

#include <gtest/gtest.h>

#include <string>

#include "bench/print/printers.h"
#include "bench/result/result_file.h"
#include "made.h"

namespace mandelmarch::bench {
namespace {

// Returns a row with times of about `seconds`. The times of different runs differ by the fraction `spread`.
Row raced(const std::string& backend, double seconds, double spread, int runs = 5)
{
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        for (int round = 0; round < 6; ++round) times.push_back(seconds * (1 + spread * (run % 3 - 1)));
    }
    return made_row(backend, times, 6);
}

struct Won {
    const char* name;
    std::vector<Row> rows;
    std::vector<std::string> lines;  // texts that the output must contain
    int runs = 5;
};

Row scalar_row()
{
    Row row = raced("openmp", 1, 0.002);
    row.sweep_value = "simd-width=1";
    row.setting.simd_width = 1;
    return row;
}

class Winners : public testing::TestWithParam<Won> {};

TEST_P(Winners, AreNamedWithTheirLeadAndItsCertainty)
{
    const std::string text = winners(made_result(GetParam().rows, GetParam().runs));
    for (const std::string& line : GetParam().lines) EXPECT_NE(text.find(line), std::string::npos) << line << text;
    EXPECT_EQ(text.find("reference"), std::string::npos) << text;
}

// Negative controls: there is no winner if the runs contradict each other, if the lead is within the margin, or if
// there are few pictures. The scalar kernel counts as another configuration, the reference does not.
INSTANTIATE_TEST_SUITE_P(
    Rows, Winners,
    testing::Values(Won{"Certain",
                        {raced("opencl", 0.25, 0.01), raced("openmp", 0.1, 0.002), raced("vulkan", 0.3, 0.01)},
                        {"for 2 comparisons\n", "mandelbox float exact: openmp won, 2.4", " times as fast as opencl [",
                         ", the next of 2, p "}},
                    Won{"Undecided",
                        {raced("opencl", 0.105, 0.1), raced("openmp", 0.1, 0.002)},
                        {"openmp leads, 1.0", "]: undecided, more runs would tell\n"}},
                    Won{"WithinTheMargin",
                        {raced("stdpar", 0.1005, 0.002), raced("openmp", 0.1, 0.002)},
                        {"openmp leads, 1.005 times as fast as stdpar [", "]: the same within 2 %\n"}},
                    Won{"FewPictures",
                        {made_row("stdpar", {0.2, 0.2}), made_row("openmp", {0.1, 0.1})},
                        {"openmp leads, 2.000 times as fast as stdpar: too few pictures to be certain\n"},
                        1},
                    Won{"Scalar",
                        {raced("openmp", 0.1, 0.002), scalar_row(), raced("reference", 0.01, 0.002)},
                        {"openmp won, 10.00 times as fast as openmp-scalar ["}}),
    [](const auto& test) { return std::string(test.param.name); });

// A single run is compared by the medians of groups of rounds, as in compare.
TEST(WinnersOfAStudy, OneRunIsComparedByGroupsOfRounds)
{
    const auto found = json_of(made_result({raced("stdpar", 0.2, 0, 1), raced("openmp", 0.1, 0, 1)}))["winners"];
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["fastest"], "mandelbox/float/exact/openmp/0");
    EXPECT_EQ(found[0]["others"][0]["verdict"], "SLOWER");
    EXPECT_NEAR(found[0]["others"][0]["ratio"], 2, 1e-12);
}

TEST(WinnersOfAStudy, LastLineHasTheNumberOfFreeProcessors)
{
    Result result = made_result({raced("openmp", 0.1, 0.01, 1)});
    result.environment["cpu"]["cores_usable"] = 2000;  // threads that OMP_NUM_THREADS asks for
    result.environment["cpu"]["cores_given"] = 8;
    result.environment["during"] = {{"others_share", 0.25}, {"stolen_share", 0.125}};
    EXPECT_TRUE(
        to_console(result, false)
            .ends_with("mandelbox float exact: openmp alone was timed\n"
                       "5.0 of 8 processors were free: other programs took 25 % of their time, the hypervisor 12 %\n"))
        << to_console(result, false);
}

}  // namespace
}  // namespace mandelmarch::bench
