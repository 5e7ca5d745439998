// SPDX-License-Identifier: Apache-2.0
// Pennycook's metric of performance portability, on examples whose result is known.
#include "bench/result/portability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "bench/print/printers.h"
#include "made.h"

namespace mandelmarch::bench {
namespace {

// The first two examples are from "Implications of a metric for performance portability": an application with the
// efficiencies 100 %, 80 %, 50 %, 100 % and 20 % on five platforms, and one that does not run on the fourth platform.
TEST(Portability, MetricIsThatOfThePapers)
{
    EXPECT_NEAR(performance_portability(std::vector{1.0, 0.8, 0.5, 1.0, 0.2}), 0.4878, 5e-5);
    EXPECT_EQ(performance_portability(std::vector{1.0, 0.8, 0.5, 0.0, 0.2}), 0);
    EXPECT_EQ(performance_portability(std::vector{1.0, 1.0, 1.0}), 1);
    EXPECT_EQ(performance_portability({}), 0);
}

Row row_of(const std::string& backend, const std::string& platform, double seconds, double operations = 0)
{
    Row row = made_row(backend, std::vector<double>(9, seconds));
    row.platform = platform;
    row.operations = operations;
    return row;
}

// Returns results on five platforms. On each platform the application `best` is the fastest, and `latest` has the
// efficiency of the paper's example. `dummy` is as fast as `latest`, but has no driver on platform D.
std::vector<Result> example()
{
    const std::map<std::string, std::pair<double, double>> times{
        {"A", {25, 25}}, {"B", {12.5, 10}}, {"C", {25, 12.5}}, {"D", {5, 5}}, {"E", {5, 1}}};
    std::vector<Result> results;
    for (const auto& [platform, seconds] : times) {
        results.push_back(
            made_result({row_of("latest", platform, seconds.first), row_of("best", platform, seconds.second),
                         row_of("dummy", platform, seconds.first)}));
        if (platform == "D") results.back().rows.back().unavailable = "no driver";
    }
    return results;
}

std::map<std::string, Portability> by_application(const std::vector<Portability>& list)
{
    std::map<std::string, Portability> found;
    for (const Portability& p : list) found[p.application] = p;
    return found;
}

TEST(Portability, OverSeveralResultFiles)
{
    auto found = by_application(portability(example()));
    ASSERT_EQ(found.size(), 3U);
    EXPECT_NEAR(found["latest"].application_portability, 0.4878, 5e-5);
    EXPECT_NEAR(found["latest"].application_interval.low, 0.4878, 5e-5) << "samples without spread";
    EXPECT_EQ(found["best"].application_portability, 1);
    EXPECT_EQ(found["dummy"].application_portability, 0) << "one platform is unsupported";
    EXPECT_EQ(found["latest"].architecture_portability, std::nullopt) << "no peak is known";
    EXPECT_EQ(found["dummy"].architecture_portability, 0) << "one platform is unsupported";
}

// If a filter left an application out of the result on a platform, the application does not count as unsupported on
// that platform. Its set of platforms, H, lacks the platform, and the output names the platform.
TEST(Portability, MissingMeasurementIsNotUnsupported)
{
    std::vector<Result> results = example();
    std::erase_if(results[3].rows, [](const Row& row) { return row.backend == "dummy"; });
    const std::vector<Portability> list = portability(results);
    const Portability dummy = by_application(list)["dummy"];
    EXPECT_NEAR(dummy.application_portability, 4 / (1 + 1.25 + 2 + 5), 1e-12);
    EXPECT_EQ(dummy.platforms.size(), 4U);
    EXPECT_EQ(dummy.not_measured, std::vector<std::string>{"D"});
    const std::string text = to_console(list);
    EXPECT_NE(text.find("dummy was not measured on D, which is not in its H: mandelbox 100x100\n"), std::string::npos)
        << text;
    EXPECT_NE(text.find("  4  D\n"), std::string::npos);
    EXPECT_NE(text.find(" 1,2,3,5 "), std::string::npos);
}

// Negative control: an application does count as unsupported on a platform if the result on that platform shows that it
// has no device, that it runs only on another platform, or that its picture is wrong.
TEST(Portability, UnavailableOrWrongIsUnsupported)
{
    std::vector<Result> results = example();
    std::erase_if(results[3].rows, [](const Row& row) { return row.backend == "dummy"; });
    Row nowhere = row_of("dummy", "", 1);
    nowhere.unavailable = "no driver";
    results[3].rows.push_back(nowhere);
    EXPECT_EQ(by_application(portability(results))["dummy"].application_portability, 0);
    results[3].rows.back() = row_of("dummy", "A", 25);
    EXPECT_EQ(by_application(portability(results))["dummy"].application_portability, 0);
    results[3].rows.back() = row_of("dummy", "D", 1);
    results[3].rows.back().verification.passed = false;
    EXPECT_EQ(by_application(portability(results))["dummy"].application_portability, 0);
}

// The added result has another picture size. Therefore it belongs to another problem.
TEST(Portability, ApplicationWithoutTheProblemHasNoEntry)
{
    std::vector<Result> results = example();
    results.push_back(made_result({row_of("best", "A", 1)}));
    results.back().rows.back().setting.width = 50;
    int of_the_size = 0;
    for (const auto& entry : json_of(portability(results)))
        of_the_size += entry["problem"] == "mandelbox 50x100" ? 1 : 0;
    EXPECT_EQ(of_the_size, 1);
}

TEST(Portability, CascadeFalls)
{
    auto found = by_application(portability(example()));
    const auto& cascade = found["latest"].cascade;
    ASSERT_EQ(cascade.size(), 5U);
    EXPECT_EQ(cascade[0].efficiency, 1);
    EXPECT_EQ(cascade[2].platform, "B");
    EXPECT_NEAR(cascade[2].portability, 3 / (1 + 1 + 1.25), 1e-12);
    EXPECT_EQ(cascade[4].platform, "E");
    EXPECT_NEAR(cascade[4].portability, 0.4878, 5e-5);
    const auto& dummy = found["dummy"].cascade;
    EXPECT_GT(dummy[3].portability, 0);
    EXPECT_EQ(dummy[4].portability, 0);
    EXPECT_EQ(dummy[4].platform, "D");
}

TEST(Portability, ArchitecturalEfficiencyIsTheShareOfThePeak)
{
    Result result = made_result({row_of("openmp", "A", 1, 25e9), row_of("opencl", "A", 2, 25e9)});
    result.peaks = {{"A", "openmp", 0, Precision::f32, 80e9}, {"A", "opencl", 0, Precision::f32, 100e9}};
    auto found = by_application(portability({&result, 1}));
    EXPECT_NEAR(found["openmp"].architecture_portability.value(), 0.25, 1e-12) << "the platform's peak is the highest";
    EXPECT_NEAR(found["opencl"].architecture_portability.value(), 0.125, 1e-12);
    EXPECT_NEAR(found["opencl"].application_portability, 0.5, 1e-12);
}

// p3-analysis-library, which reads this CSV, takes a missing line for "did not run", and fails on an empty cell.
TEST(Portability, CsvHasALineForEachApplicationThatRuns)
{
    std::vector<Result> results = example();
    results[0].rows.push_back(row_of("reference", "A", 9));
    results[0].rows.push_back(row_of("vulkan", "", 1));
    results[0].rows.back().unavailable = "no driver";
    for (Row& row : results[1].rows) {
        if (row.backend == "best") row.platform = "B, the second";
    }
    std::istringstream csv(to_csv(portability(results)));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "problem,application,platform,fom,h");
    std::vector<std::string> lines;
    while (std::getline(csv, line)) lines.push_back(line);
    EXPECT_EQ(lines.size(), 14U);
    const std::string h = "\"A; B; B, the second; C; D; E\"";
    EXPECT_NE(std::ranges::find(lines, "mandelbox float exact 100x100,latest,A,400," + h), lines.end());
    EXPECT_NE(std::ranges::find(lines, "mandelbox float exact 100x100,best,\"B, the second\",1000," + h), lines.end());
    for (const std::string& one : lines) {
        EXPECT_EQ(one.find("reference"), std::string::npos);
        EXPECT_EQ(one.find("vulkan"), std::string::npos);
        EXPECT_EQ(one.find(",,"), std::string::npos);
        EXPECT_FALSE(one.ends_with(','));
    }
}

}  // namespace
}  // namespace mandelmarch::bench
