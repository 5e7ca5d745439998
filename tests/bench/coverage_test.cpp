// SPDX-License-Identifier: Apache-2.0
// Measures the coverage of bench's intervals: the fraction of synthetic studies in which an interval contains the true
// value. In the studies, each run has its own speed, and samples have skewed disturbances. The negative controls are
// simpler methods, whose coverage must be too low.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "bench/result/figures.h"
#include "bench/result/portability.h"
#include "made.h"

namespace mandelmarch::bench {
namespace {

constexpr double run_scatter = 0.015;  // standard deviations of logarithms, as in results/bench.json
constexpr double sample_scatter = 0.02;
constexpr double target = 0.93;
constexpr int studies = 2000;
// Median of the chi-squared distribution with one degree of freedom. The disturbances have this distribution, which is
// skewed. Its median is subtracted, so that the disturbances do not change the median time.
constexpr double skew_median = 0.4549364;

using Random = std::mt19937_64;

// Returns, for each run, the factor by which the machine's state in the run multiplies the times of all rows.
std::map<int, double> machine(Random& random, int runs)
{
    std::normal_distribution<double> normal;
    std::map<int, double> factors;
    for (int run = 0; run < runs; ++run) factors[run] = std::exp(0.03 * normal(random));
    return factors;
}

// Returns a row whose median time is `seconds`, with `samples` samples in each run.
Row study_row(Random& random, const std::string& backend, double seconds, const std::map<int, double>& factors,
              int samples)
{
    std::normal_distribution<double> normal;
    Row row = made_row(backend, {});
    for (const auto& [run, factor] : factors) {
        const double speed = seconds * factor * std::exp(run_scatter * normal(random));
        for (int round = 0; round < samples; ++round) {
            const double x = normal(random);
            const double time = speed * std::exp(sample_scatter * (x * x - skew_median));
            row.samples.push_back({.run = run, .round = round, .kernel = time, .wall = time});
        }
    }
    return row;
}

// Makes `of` studies and returns the fraction of them for which interval(random) contains `truth`.
double coverage(double truth, const std::function<Interval(Random&)>& interval, int of = studies)
{
    Random random(3);
    int held = 0;
    for (int i = 0; i < of; ++i) {
        const Interval found = interval(random);
        held += found.low <= truth && truth <= found.high ? 1 : 0;
    }
    return static_cast<double>(held) / of;
}

class Coverage : public testing::TestWithParam<int> {
protected:
    int runs() const { return GetParam(); }
    // Returns the factor 1 for each run, because here the machine affects all runs alike.
    std::map<int, double> quiet() const
    {
        std::map<int, double> factors;
        for (int run = 0; run < runs(); ++run) factors[run] = 1;
        return factors;
    }
};

INSTANTIATE_TEST_SUITE_P(Runs, Coverage, testing::Values(3, 5, 10));

// Negative control: an interval computed from all samples, as if the samples of one run were independent, is too
// narrow.
TEST_P(Coverage, OfATime)
{
    const auto interval = [&](Random& random) {
        return summary(kernel_runs(study_row(random, "openmp", 0.1, quiet(), 12))).interval.value();
    };
    EXPECT_GE(coverage(0.1, interval), target);
    const auto pooled = [&](Random& random) {
        return summary(kernel_times(study_row(random, "openmp", 0.1, quiet(), 12))).interval.value();
    };
    EXPECT_LT(coverage(0.1, pooled), 0.85);
}

// Returns the interval of the speed-up in a synthetic study. The reference has three samples per run, and the row whose
// speed-up is measured has twelve.
Interval speed_up(Random& random, int runs, double reference_seconds)
{
    const auto factors = machine(random, runs);
    Row reference = study_row(random, "reference", reference_seconds, factors, 3);
    const Row row = study_row(random, "openmp", 0.1, factors, 12);
    reference.precision = Precision::f64;
    const Result result = made_result({reference, row}, runs);
    return result.rows[1].figures->speed_up->interval.value();
}

// Negative control: if the true speed-up is 43, intervals contain 40 too rarely.
TEST_P(Coverage, OfASpeedUp)
{
    EXPECT_GE(coverage(40, [&](Random& random) { return speed_up(random, runs(), 4); }), target);
    EXPECT_LT(coverage(40, [&](Random& random) { return speed_up(random, runs(), 4.3); }), 0.8);
}

TEST_P(Coverage, OfPortability)
{
    // On one platform the slower backend takes 2 times as long as the other backend, on a second platform 1.25 times.
    // Therefore its efficiencies are 0.5 and 0.8.
    const auto interval = [&](Random& random) {
        std::vector<Result> results;
        for (const auto& [platform, seconds] : {std::pair("A", 0.2), {"B", 0.125}}) {
            Result result = made_result(
                {study_row(random, "best", 0.1, quiet(), 8), study_row(random, "other", seconds, quiet(), 8)}, runs());
            for (Row& row : result.rows) row.platform = platform;
            results.push_back(std::move(result));
        }
        return portability(results).at(1).application_interval;
    };
    EXPECT_GE(coverage(2 / (1 / 0.5 + 1 / 0.8), interval, 300), target);
}

// Negative control: an interval from a single run does not include the differences between runs. Therefore it contains
// the true value too rarely.
TEST(CoverageOfOneRun, IsTooLow)
{
    const auto interval = [](Random& random) {
        return summary(kernel_runs(study_row(random, "openmp", 0.1, {{0, 1}}, 12))).interval.value();
    };
    EXPECT_LT(coverage(0.1, interval), 0.8);
}

// If runs do not differ, an interval from a single run contains the true ratio often enough, even for skewed times.
TEST(CoverageOfOneRun, OfAQuotientWithoutDifferencesOfRuns)
{
    const auto interval = [](Random& random) {
        std::normal_distribution<double> normal;
        const auto times = [&](double seconds) {
            std::vector<double> made;
            for (int i = 0; i < 12; ++i) {
                const double x = normal(random);
                made.push_back(seconds * std::exp(0.1 * (x * x - skew_median)));
            }
            return ValuesByRun{{0, made}};
        };
        return quotient(times(4), times(0.1)).interval.value();
    };
    EXPECT_GE(coverage(40, interval), target);
}

TEST(SpeedUp, OfTheReferenceBesideItselfHasNoInterval)
{
    Random random(3);
    Row reference = study_row(random, "reference", 4, {{0, 1}, {1, 1}, {2, 1}}, 6);
    reference.precision = Precision::f64;
    const Result result = made_result({reference}, 3);
    const Figures figures = result.rows[0].figures.value();
    EXPECT_EQ(figures.speed_up->ratio, 1);
    EXPECT_FALSE(figures.speed_up->interval);
}

}  // namespace
}  // namespace mandelmarch::bench
