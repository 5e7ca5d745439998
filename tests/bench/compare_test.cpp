// SPDX-License-Identifier: Apache-2.0
// `bench compare` on synthetic results with known differences.
#include "bench/result/compare.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/text/error.h"
#include "made.h"

namespace mandelmarch::bench {
namespace {

constexpr int rows = 24;
constexpr int runs = 5;
constexpr int samples = 10;

Row numbered_row(int index) { return made_row(fmt::format("backend{}", index), {}); }

// Returns a result with realistic times. Each run has its own speed, with a standard deviation of 1.5 %, and each
// sample is disturbed, with a standard deviation of 1 %. The times of row i are multiplied by factor(i).
Result random_result(std::mt19937_64& random, const std::function<double(int)>& factor, int of_runs = runs)
{
    std::normal_distribution<double> normal;
    Result result;
    result.runs = of_runs;
    for (int i = 0; i < rows; ++i) {
        Row row = numbered_row(i);
        for (int run = 0; run < of_runs; ++run) {
            const double speed = 0.1 * factor(i) * std::exp(0.015 * normal(random));
            for (int s = 0; s < samples; ++s) {
                const double seconds = speed * std::exp(0.01 * normal(random));
                row.samples.push_back({.run = run, .round = s, .kernel = seconds, .wall = seconds});
            }
        }
        result.rows.push_back(row);
    }
    return result;
}

// Returns the factor of row i. With these factors false alarms are most frequent, because every row differs by exactly
// the margin.
double at_the_margin(int i) { return i % 2 == 0 ? 1 + margin : 1 / (1 + margin); }

// Makes 100 pairs of results and returns the number of pairs for which alarm(before, after) is true. In `after`, the
// times of row i are factor(i) times as long as in `before`.
template <class Alarm>
int alarms(const std::function<double(int)>& factor, Alarm alarm)
{
    std::mt19937_64 random(5);
    int count = 0;
    for (int study = 0; study < 100; ++study) {
        const Result before = random_result(random, same);
        const Result after = random_result(random, factor);
        count += alarm(before, after) ? 1 : 0;
    }
    return count;
}

bool compare_alarms(const Result& before, const Result& after)
{
    return called(compare_results(before, after).rows) > 0;
}

// Returns true if a row is called faster or slower by a method like compare's, but without Holm's correction.
bool uncorrected_alarms(const Result& before, const Result& after)
{
    for (std::size_t i = 0; i < before.rows.size(); ++i) {
        if (difference(run_medians(before.rows[i]), run_medians(after.rows[i]), margin).p < significance) return true;
    }
    return false;
}

// Negative control: without Holm's correction there are many false alarms.
TEST(Compare, RaisesFewFalseAlarms)
{
    EXPECT_LE(alarms(same, compare_alarms), 5) << "builds that are the same";
    EXPECT_LE(alarms(at_the_margin, compare_alarms), 10) << "5 in 100 is expected here, 10 is its 98th percentile";
    EXPECT_GT(alarms(at_the_margin, uncorrected_alarms), 30);
}

TEST(Compare, FindsARegressionAndAnImprovement)
{
    std::mt19937_64 random(7);
    const Result before = random_result(random, same);
    const Result after = random_result(random, [](int i) { return i == 3 ? 1.15 : i == 8 ? 0.85 : 1.0; });
    const ComparedResults compared = compare_results(before, after);
    EXPECT_EQ(compared.rows[3].verdict, Verdict::slower);
    EXPECT_EQ(compared.rows[8].verdict, Verdict::faster);
    EXPECT_EQ(called(compared.rows), 2);
    EXPECT_TRUE(regression(compared.rows));
    EXPECT_NEAR(compared.rows[3].difference.ratio, 1.15, 0.05);
    EXPECT_TRUE(compared.warnings.empty());
    EXPECT_FALSE(regression(compare_results(before, before).rows));
}

TEST(Compare, DifferenceWithinTheMarginIsSame)
{
    // The times have no noise. The difference is certain, but within the margin.
    const Result before = made_result({made_row("openmp", {1, 1}, 1)}, 2);
    Result after = before;
    for (Sample& sample : after.rows[0].samples) sample.kernel = 1.019;
    EXPECT_EQ(compare_results(before, after).rows[0].verdict, Verdict::same);
    for (Sample& sample : after.rows[0].samples) sample.kernel = 1.03;
    EXPECT_EQ(compare_results(before, after).rows[0].verdict, Verdict::slower);
}

// One of 48 rows takes half the time. But there are only three runs, too few for this difference to be significant
// after Holm's correction for 48 rows. The verdict must be `undecided`, not `same`.
TEST(Compare, HalvingThatIsNotSignificantIsUndecided)
{
    Result before;
    before.runs = 3;
    for (int i = 0; i < 48; ++i) before.rows.push_back(made_row(fmt::format("backend{}", i), {1, 1.001, 1.002}, 1));
    Result after = before;
    for (int run = 0; run < 3; ++run) after.rows[0].samples[run].kernel = 0.5 * (1 + 0.08 * run);
    const ComparedResults compared = compare_results(before, after);
    EXPECT_LT(compared.rows[0].difference.interval.high, 0.8);
    EXPECT_GE(compared.rows[0].p, significance);
    EXPECT_EQ(compared.rows[0].verdict, Verdict::undecided);
    EXPECT_EQ(compared.rows[1].verdict, Verdict::same);
    EXPECT_FALSE(regression(compared.rows));
    const std::string text = to_console(compared);
    EXPECT_EQ(text.find("no difference"), std::string::npos);
    EXPECT_TRUE(text.ends_with("verdicts: 47 same within 2 %, 1 undecided (more runs would tell: --runs)\n")) << text;
}

std::vector<Verdict> verdicts(const std::vector<Difference>& differences, double within)
{
    std::vector<Compared> compared;
    for (const Difference& difference : differences) {
        compared.push_back({.name = "row", .verdict = Verdict::undecided, .difference = difference});
    }
    set_verdicts(compared, within);
    std::vector<Verdict> found;
    for (const Compared& row : compared) found.push_back(row.verdict);
    return found;
}

TEST(Verdicts, EachVerdict)
{
    const Difference same_within_two{.ratio = 1.001, .interval = {0.99, 1.012}, .p = 1};
    const Difference slower_alone{.ratio = 1.3, .interval = {1.05, 1.6}, .p = 0.02};
    const std::vector<Difference> made{{.ratio = 1.2, .interval = {1.1, 1.3}, .p = 1e-4},
                                       {.ratio = 0.8, .interval = {0.7, 0.9}, .p = 1e-4},
                                       same_within_two,
                                       {.ratio = 1.001, .interval = {0.97, 1.03}, .p = 1},
                                       slower_alone};
    const std::vector<Verdict> expected{Verdict::slower, Verdict::faster, Verdict::same, Verdict::undecided,
                                        Verdict::undecided};
    EXPECT_EQ(verdicts(made, 0.02), expected) << "the last is significant alone, and not among five";
    EXPECT_EQ(verdicts({slower_alone}, 0.02)[0], Verdict::slower);
    EXPECT_EQ(verdicts({same_within_two}, 0.01)[0], Verdict::undecided) << "a narrower margin";
}

TEST(Compare, LossOfASpeedIsARegression)
{
    struct Loss {
        std::string why;
        std::function<void(Row&)> change;  // changes a row of the new result
        Verdict verdict = Verdict::missing;
    };
    const std::vector<Loss> losses{
        {"not in the new result", [](Row& row) { row.backend = "another"; }},
        {"new: unavailable: no device", [](Row& row) { row.unavailable = "no device"; }},
        {"new: unavailable: no driver",
         [](Row& row) {
             row.fractal = "all";
             row.platform = row.device_name = "";
             row.unavailable = "no driver";
         }},
        {"new: it was not timed", [](Row& row) { row.samples.clear(); }},
        {"new: samples of one run only", [](Row& row) { row.samples.resize(1); }},
        {"new: a time is not above 0", [](Row& row) { row.samples[7].kernel = 0; }},
        {"other settings: 100x100 and 270x100", [](Row& row) { row.setting.width = 270; }},
        {"new: the picture is wrong", [](Row& row) { row.failure = "the picture is wrong"; }, Verdict::wrong}};
    std::mt19937_64 random(7);
    const Result before = random_result(random, same);
    for (const Loss& loss : losses) {
        SCOPED_TRACE(loss.why);
        Result after = before;
        loss.change(after.rows[3]);
        const ComparedResults compared = compare_results(before, after);
        EXPECT_TRUE(regression(compared.rows));
        const auto found = std::ranges::find(compared.rows, before.rows[3].name(), &Compared::name);
        ASSERT_NE(found, compared.rows.end());
        EXPECT_EQ(found->verdict, loss.verdict);
        EXPECT_EQ(found->why, loss.why);
        EXPECT_NE(to_console(compared).find(found->name), std::string::npos);
    }
    EXPECT_THROW(compare_results(before, made_result({numbered_row(77)})), InputError);
}

TEST(Compare, NewRowsAreNotRegressions)
{
    std::mt19937_64 random(7);
    const Result after = random_result(random, same);
    Result before = after;
    before.rows[1].unavailable = "no device";
    before.rows.erase(before.rows.begin() + 3);
    const ComparedResults compared = compare_results(before, after);
    EXPECT_FALSE(regression(compared.rows));
    EXPECT_EQ(compared.rows[1].verdict, Verdict::only_new);
    EXPECT_EQ(compared.rows[3].verdict, Verdict::only_new);
    EXPECT_NE(to_console(compared).find("new: not in the old result"), std::string::npos);
}

TEST(Compare, WarningsOfBothResultsAreShown)
{
    std::mt19937_64 random(7);
    Result before = random_result(random, same);
    Result after = before;
    before.warnings = {"load: 7 threads"};
    after.warnings = {"frequency:\x1b[2J 1 to 2 MHz"};
    const std::string text = to_console(compare_results(before, after));
    EXPECT_NE(text.find("warning: old result: load: 7 threads\n"), std::string::npos) << text;
    EXPECT_NE(text.find("warning: new result: frequency:\\x1b[2J 1 to 2 MHz\n"), std::string::npos) << text;
}

// If both results have one run, a single disturbed picture must not lead to the verdict `slower`. A comparison of the
// mean logarithms of times would give this verdict.
TEST(Compare, OneRunIsComparedByMedians)
{
    std::mt19937_64 random(7);
    const Result before = random_result(random, same, 1);
    Result after = before;
    after.rows[3].samples[4].kernel *= 1000;
    const ComparedResults compared = compare_results(before, after);
    ASSERT_EQ(compared.warnings.size(), 1U);
    EXPECT_NE(compared.warnings[0].find("differences between runs are unseen"), std::string::npos);
    EXPECT_NEAR(compared.rows[3].difference.ratio, 1, 0.02);
    EXPECT_GT(difference(kernel_times(before.rows[3]), kernel_times(after.rows[3]), margin).ratio, 1.9);
}

}  // namespace
}  // namespace mandelmarch::bench
