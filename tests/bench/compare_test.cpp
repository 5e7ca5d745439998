// bench compare on made results, whose truth is known.
#include "bench/compare.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "bench/figures.h"
#include "bench/launches.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

constexpr int rows = 24;
constexpr int launches = 5;
constexpr int samples = 10;

Row made_row(int index)
{
    Row row;
    row.fractal = "mandelbulb";
    row.backend = fmt::format("backend{}", index);
    row.platform = "machine";
    row.device_name = "device";
    row.proof.drawn = row.proof.fine = true;
    row.setting.width = row.setting.height = 540;
    return row;
}

// Times as machines make them: each launch has a speed of its own (1.5 %), and each sample a disturbance (1 %). Row i
// takes factor(i) times as long as others.
Result made_result(std::mt19937_64& random, const std::function<double(int)>& factor, int of_launches = launches)
{
    std::normal_distribution<double> normal;
    Result result;
    result.launches = of_launches;
    for (int i = 0; i < rows; ++i) {
        Row row = made_row(i);
        for (int launch = 0; launch < of_launches; ++launch) {
            const double speed = 0.1 * factor(i) * std::exp(0.015 * normal(random));
            for (int s = 0; s < samples; ++s) {
                const double seconds = speed * std::exp(0.01 * normal(random));
                row.samples.push_back({.launch = launch, .round = s, .kernel = seconds, .wall = seconds});
            }
        }
        result.rows.push_back(row);
    }
    return result;
}

double same(int) { return 1; }

int called(const ComparedResults& compared)
{
    return static_cast<int>(std::ranges::count_if(compared.rows, [](const Compared& row) {
        return row.verdict == Verdict::faster || row.verdict == Verdict::slower;
    }));
}

// Of 100 studies of builds that differ by `factor` in every row, those in which `alarm` sounds.
template <class Alarm>
int alarms(const std::function<double(int)>& factor, Alarm alarm)
{
    std::mt19937_64 random(5);
    int count = 0;
    for (int study = 0; study < 100; ++study) {
        const Result before = made_result(random, same);
        const Result after = made_result(random, factor);
        count += alarm(before, after) ? 1 : 0;
    }
    return count;
}

bool compare_alarms(const Result& before, const Result& after) { return called(compare_results(before, after)) > 0; }

// As compare does, without Holm's correction.
bool uncorrected_alarms(const Result& before, const Result& after)
{
    for (std::size_t i = 0; i < before.rows.size(); ++i) {
        if (difference(launch_medians(before.rows[i]), launch_medians(after.rows[i]), margin).p < significance)
            return true;
    }
    return false;
}

// As compare does, with samples taken for units, as if those of one launch were independent.
bool pooled_alarms(const Result& before, const Result& after)
{
    std::vector<double> p;
    for (std::size_t i = 0; i < before.rows.size(); ++i) {
        p.push_back(difference(kernel_times(before.rows[i]), kernel_times(after.rows[i]), margin).p);
    }
    return std::ranges::any_of(holm(p), [](double adjusted) { return adjusted < significance; });
}

TEST(Compare, RaisesFewFalseAlarms)
{
    EXPECT_LE(alarms(same, compare_alarms), 5) << "builds that are the same";
    // The hardest case of "no difference": every row differs by just the margin.
    const auto at_the_margin = [](int i) { return i % 2 == 0 ? 1 + margin : 1 / (1 + margin); };
    EXPECT_LE(alarms(at_the_margin, compare_alarms), 10) << "5 in 100 is expected here, 10 is its 98th percentile";
}

// The twins: each shortcut is found out by the same count of alarms.
TEST(Compare, ShortcutsRaiseMany)
{
    const auto at_the_margin = [](int i) { return i % 2 == 0 ? 1 + margin : 1 / (1 + margin); };
    EXPECT_GT(alarms(at_the_margin, uncorrected_alarms), 30) << "without Holm's correction";
    EXPECT_GT(alarms(at_the_margin, pooled_alarms), 30) << "samples of one launch taken for independent";
}

TEST(Compare, FindsARegressionAndAnImprovement)
{
    std::mt19937_64 random(7);
    const Result before = made_result(random, same);
    const Result after = made_result(random, [](int i) { return i == 3 ? 1.15 : i == 8 ? 0.85 : 1.0; });
    const ComparedResults compared = compare_results(before, after);
    EXPECT_EQ(compared.rows[3].verdict, Verdict::slower);
    EXPECT_EQ(compared.rows[8].verdict, Verdict::faster);
    EXPECT_EQ(called(compared), 2);
    EXPECT_TRUE(compared.regression());
    EXPECT_NEAR(compared.rows[3].difference.ratio, 1.15, 0.05);
    EXPECT_TRUE(compared.warnings.empty());
    EXPECT_FALSE(compare_results(before, before).regression());
}

TEST(Compare, AnImprovementAloneIsNoRegression)
{
    std::mt19937_64 random(7);
    const Result before = made_result(random, same);
    EXPECT_FALSE(compare_results(before, made_result(random, [](int i) { return i == 8 ? 0.8 : 1.0; })).regression());
}

TEST(Compare, NothingUnderTheMarginIsADifference)
{
    // No noise at all: the difference is certain, and too small.
    Result before;
    before.launches = 2;
    before.rows.push_back(made_row(0));
    for (const int launch : {0, 1}) before.rows[0].samples.push_back({.launch = launch, .kernel = 1, .wall = 1});
    Result after = before;
    for (Sample& sample : after.rows[0].samples) sample.kernel = 1.019;
    EXPECT_EQ(compare_results(before, after).rows[0].verdict, Verdict::no_difference);
    for (Sample& sample : after.rows[0].samples) sample.kernel = 1.03;
    EXPECT_EQ(compare_results(before, after).rows[0].verdict, Verdict::slower);
}

TEST(Compare, ABrokenPictureIsARegression)
{
    std::mt19937_64 random(7);
    const Result before = made_result(random, same);
    Result after = before;
    after.rows[2].proof.fine = false;
    after.rows[2].failure = "the picture is wrong";
    after.rows[2].samples.clear();
    const ComparedResults compared = compare_results(before, after);
    EXPECT_EQ(compared.rows[2].verdict, Verdict::broken);
    EXPECT_TRUE(compared.regression());
}

TEST(Compare, WhatCannotBeComparedSaysWhy)
{
    std::mt19937_64 random(7);
    const Result before = made_result(random, same, 1);
    Result after = made_result(random, same, 1);
    after.rows[0].setting.width = 270;
    after.rows[1].backend = "another";
    after.rows[2].unavailable = "no device";
    const ComparedResults compared = compare_results(before, after);
    EXPECT_EQ(compared.rows[0].verdict, Verdict::not_compared);
    EXPECT_NE(compared.rows[0].why.find("other settings"), std::string::npos);
    EXPECT_EQ(compared.rows[1].why, "not in the old result");
    EXPECT_EQ(compared.rows[2].verdict, Verdict::not_compared);
    EXPECT_EQ(compared.rows.back().why, "not in the new result");
    ASSERT_EQ(compared.warnings.size(), 1U);
    EXPECT_NE(compared.warnings[0].find("unseen"), std::string::npos);
    Result other;
    other.rows.push_back(made_row(77));
    EXPECT_THROW(compare_results(before, other), InputError);
}

TEST(Launches, AreMergedByRow)
{
    std::mt19937_64 random(9);
    std::vector<Result> results;
    for (int launch = 0; launch < 3; ++launch) {
        results.push_back(made_result(random, same, 1));
        for (Row& row : results.back().rows) {
            for (Sample& sample : row.samples) sample.launch = launch;
        }
        results.back().peaks.push_back({"machine", "openmp", 0, Precision::f64, 100.0 + launch});
    }
    results[1].rows[4].failure = "died";
    const Result all = merged(results);
    EXPECT_EQ(all.launches, 3);
    EXPECT_EQ(launch_medians(all.rows[0]).size(), 3U);
    EXPECT_EQ(all.rows[0].samples.size(), 3U * samples);
    ASSERT_EQ(all.peaks.size(), 1U);
    EXPECT_EQ(all.peaks[0].rate, 102);
    EXPECT_TRUE(all.rows[4].failed());
    EXPECT_FALSE(all.rows[4].timed());
}

}  // namespace
}  // namespace mandelmarch::bench
