// SPDX-License-Identifier: Apache-2.0
// Statistics on values with known results.
#include "bench/statistics/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace mandelmarch::bench {
namespace {

std::vector<double> upto(int n)
{
    std::vector<double> values(static_cast<std::size_t>(n));
    std::iota(values.begin(), values.end(), 1.0);
    return values;
}

TEST(Statistics, MedianAndDeviation)
{
    EXPECT_EQ(median({3, 1, 2}), 2);
    EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
    EXPECT_EQ(median({}), 0);
    const std::vector<double> values{1, 1, 2, 2, 4, 6, 9};
    const Summary s = summary(values);
    EXPECT_EQ(s.median, 2);
    EXPECT_EQ(s.mad, 1);
    EXPECT_EQ(s.min, 1);
    EXPECT_EQ(s.max, 9);
    EXPECT_EQ(s.count, 7);
}

// Each pair has a number of values n and the rank of the lower end of the sign test's interval. The ranks were computed
// from the binomial distribution.
TEST(Statistics, IntervalHasTheRanksOfTheTable)
{
    for (const auto& [n, rank] : {std::pair(6, 1), {8, 1}, {9, 2}, {10, 2}, {15, 4}, {20, 6}, {25, 8}, {40, 14}}) {
        const auto interval = median_interval(upto(n));
        ASSERT_TRUE(interval) << n;
        EXPECT_EQ(interval->low, rank) << n;
        EXPECT_EQ(interval->high, n + 1 - rank) << n;
    }
    EXPECT_FALSE(median_interval(upto(5)));
    EXPECT_FALSE(median_interval({}));
}

// An example like that in Holm's paper: the p-values 0.01, 0.04, 0.03, 0.005 become 0.03, 0.06, 0.06, 0.02.
TEST(Statistics, HolmByHand)
{
    const std::vector<double> p{0.01, 0.04, 0.03, 0.005};
    const auto adjusted = holm(p);
    ASSERT_EQ(adjusted.size(), 4U);
    EXPECT_NEAR(adjusted[0], 0.03, 1e-12);
    EXPECT_NEAR(adjusted[1], 0.06, 1e-12);
    EXPECT_NEAR(adjusted[2], 0.06, 1e-12);
    EXPECT_NEAR(adjusted[3], 0.02, 1e-12);
    EXPECT_TRUE(holm({}).empty());
    EXPECT_EQ(holm(std::vector<double>{0.9, 0.8})[0], 1);
}

// The values have the logarithms -1, 0, 1 and 1, 2, 3. The means differ by 2, and the variance of each mean is 1/3.
// Therefore t = 2 / sqrt(2/3) = 2.449 with 4 degrees of freedom. By tables of Student's t, the two-sided p without a
// margin is 0.0705.
TEST(Statistics, WelchByHand)
{
    const std::vector<double> a{std::exp(-1.0), 1, std::exp(1.0)};
    const std::vector<double> b{std::exp(1.0), std::exp(2.0), std::exp(3.0)};
    const Difference d = difference(a, b, 0);
    EXPECT_NEAR(d.ratio, std::exp(2.0), 1e-9);
    EXPECT_NEAR(d.degrees, 4, 1e-9);
    EXPECT_NEAR(d.p, 0.0705, 1e-4);
    // 2.776 is the 97.5th percentile of t with 4 degrees of freedom.
    EXPECT_NEAR(std::log(d.interval.high), 2 + 2.7764 * std::sqrt(2.0 / 3), 1e-3);
    EXPECT_GT(difference(a, b, 0.5).p, d.p) << "a margin makes a difference less sure";
}

TEST(Statistics, EqualValuesAreCertain)
{
    const std::vector<double> a{2, 2, 2};
    const std::vector<double> b{3, 3, 3};
    EXPECT_EQ(difference(a, b, 0.02).p, 0);
    EXPECT_EQ(difference(a, a, 0.02).p, 1);
}

TEST(RunInterval, ByHand)
{
    // The logarithms -1, 0, 1 have the mean 0 and the standard error 1 / sqrt(3). The 97.5th percentile of t with two
    // degrees of freedom is 4.3027.
    const auto interval = run_interval(std::vector{std::exp(-1.0), 1.0, std::exp(1.0)});
    ASSERT_TRUE(interval);
    EXPECT_NEAR(std::log(interval->high), 4.3027 / std::sqrt(3.0), 1e-3);
    EXPECT_NEAR(interval->low * interval->high, 1, 1e-12);
    EXPECT_FALSE(run_interval(std::vector{1.0}));
    EXPECT_FALSE(run_interval(std::vector{1.0, 0.0, 2.0}));
}

TEST(RunInterval, ContainsTheMedianOfAll)
{
    // One run has many more samples than the others.
    ValuesByRun runs{{0, {1.0}}, {1, {1.0}}, {7, {2, 2, 2, 2, 2}}};
    const Summary s = summary(runs);
    EXPECT_EQ(s.count, 7);
    EXPECT_EQ(s.runs, 3);
    EXPECT_EQ(s.median, 2);
    EXPECT_GE(s.interval->high, 2);
}

// The quotient's interval is that of the median over rounds. It needs six rounds.
TEST(QuotientOfOneRun, HasTheIntervalOfTheRoundsMedian)
{
    const ValuesByRun row{{0, {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}}};
    EXPECT_FALSE(quotient({{0, {9, 8, 7, 6, 5}}}, row).interval) << "five rounds";
    const Quotient q = quotient({{0, {9, 8, 7, 6, 5, 40}}}, row);
    EXPECT_EQ(q.ratio, 7.5);
    ASSERT_TRUE(q.interval);
    EXPECT_EQ(q.interval->low, 5);
    EXPECT_EQ(q.interval->high, 40);
    EXPECT_FALSE(quotient({{0, {9, 8, 7, 6, 5, 0}}}, row).interval) << "a time that is not above 0";
}

// A disturbance that slows both rows of a round does not change the ratio of their times.
TEST(QuotientOfOneRun, ComparesRoundByRound)
{
    const Quotient q = quotient({{0, {2, 2, 18, 2, 6, 2}}}, {{0, {1, 1, 9, 1, 3, 1}}});
    ASSERT_TRUE(q.interval);
    EXPECT_EQ(q.interval->low, 2);
    EXPECT_EQ(q.interval->high, 2);
}

}  // namespace
}  // namespace mandelmarch::bench
