// SPDX-License-Identifier: Apache-2.0
// Peaks are measured on simulated devices whose rate is known. Some of a device's kernel runs are disturbed.
#include "core/render/peak.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "bench/measure/peaks.h"

namespace mandelmarch {
namespace {

constexpr double seconds_per_round = 1e-7;
constexpr double start_seconds = 1e-5;  // time of a kernel run before its rounds begin
constexpr double lanes = 16;
constexpr double true_rate = peak_operations_per_round * lanes / seconds_per_round;

// Returns a simulated device. disturbance(run) is added to the time of each kernel run, in seconds; runs are counted
// from 0.
PeakRun device(const std::function<double(int run)>& disturbance)
{
    return [=, run = 0](int rounds) mutable { return start_seconds + rounds * seconds_per_round + disturbance(run++); };
}

// Measures 20 devices. On the n-th of them, only the n-th kernel run is disturbed. Returns the lowest rate that
// measured() gives.
double worst_rate(const std::function<double(const PeakRun&)>& measured)
{
    double worst = true_rate;
    for (int one = 0; one < 20; ++one) {
        worst = std::min(worst, measured(device([=](int run) { return run == one ? 0.05 : 0; })));
    }
    return worst;
}

// Negative control: a method that increases the rounds only until the first kernel run that is long enough. If that run
// is long because it was disturbed, the rounds are too few.
double calibrated_on_one_run(const PeakRun& run)
{
    int rounds = 256;
    run(rounds);
    double seconds = run(rounds);
    for (; seconds < 0.02; seconds = run(rounds)) rounds *= 8;
    for (int i = 0; i < 8; ++i) seconds = std::min(seconds, run(rounds));
    return peak_operations_per_round * rounds * lanes / seconds;
}

TEST(Peak, OneDisturbedRunDoesNotChangeIt)
{
    EXPECT_NEAR(worst_rate([](const PeakRun& run) { return highest_rate(run, lanes); }) / true_rate, 1, 0.001);
    EXPECT_LT(worst_rate(calibrated_on_one_run) / true_rate, 0.8) << "negative control: a disturbance must matter";
}

TEST(Peak, BusyMachineIsMeasuredInItsQuietRuns)
{
    const PeakRun busy = device([](int run) { return run % 4 == 3 ? 0 : 0.03; });
    EXPECT_NEAR(highest_rate(busy, lanes) / true_rate, 1, 0.001);
}

TEST(Peak, RunWithoutATimeHasNoRate)
{
    EXPECT_EQ(highest_rate([](int) { return 0.0; }, lanes), 0);
}

TEST(Peak, DeviceThatIsTooFastForTheClockHasTheMostRounds)
{
    int most = 0;
    const double rate = highest_rate(
        [&](int rounds) {
            most = std::max(most, rounds);
            return rounds * 1e-13;
        },
        1);
    EXPECT_NEAR(rate / (peak_operations_per_round / 1e-13), 1, 1e-9);
    EXPECT_EQ(most, 1 << 28);
}

// Returns a measurement that gives the rates one after the other, and then always the last one.
bench::PeakMeasurement measurements(std::vector<double> rates)
{
    return [rates = std::move(rates), next = std::size_t{0}](const auto& wanted) mutable {
        const bench::Peak peak{"machine", "openmp", 0, Precision::f32, rates[std::min(next++, rates.size() - 1)]};
        return wanted(peak) ? std::vector{peak} : std::vector<bench::Peak>{};
    };
}

// Returns the peaks of settled_peaks() if its measurements give these rates, one after the other: the first before the
// rounds, the second after them, further ones only if they are necessary.
std::vector<bench::Peak> settled(const std::vector<double>& rates)
{
    const bench::PeakMeasurement measure = measurements(rates);
    std::vector<bench::Peak> both = measure(bench::every_peak);
    both.push_back(measure(bench::every_peak).front());
    return bench::settled_peaks(std::move(both), measure);
}

double highest(const std::vector<bench::Peak>& peaks) { return std::ranges::max(peaks, {}, &bench::Peak::rate).rate; }

TEST(Peaks, DisturbedOneIsMeasuredAgain)
{
    const auto peaks = settled({100e9, 240e9, 90e9, 242e9, 1});
    EXPECT_EQ(highest(peaks), 242e9);
    EXPECT_TRUE(bench::peak_warnings(peaks).empty());
}

TEST(Peaks, AgreeingOnesAreNotMeasuredAgain)
{
    // The first two rates agree, so there is no third measurement, which would give 500e9.
    EXPECT_EQ(highest(settled({240e9, 242e9, 500e9})), 242e9);
}

TEST(Peaks, OnlyDoubtfulOnesAreMeasuredAgain)
{
    const bench::Peak sure{"machine", "openmp", 0, Precision::f64, 100};
    const bench::Peak disturbed{"machine", "opencl", 1, Precision::f64, 50};
    const bench::Peak quiet{"machine", "opencl", 1, Precision::f64, 100};
    int measured = 0;
    static_cast<void>(bench::settled_peaks({sure, disturbed, sure, quiet}, [&](const auto& wanted) {
        EXPECT_FALSE(wanted(sure));
        EXPECT_TRUE(wanted(disturbed));
        ++measured;
        return std::vector{quiet};
    }));
    EXPECT_EQ(measured, 1);
}

TEST(Peaks, OnesThatNeverAgreeAreAWarning)
{
    const auto peaks = settled({100e9, 200e9, 300e9, 400e9, 500e9, 600e9});
    EXPECT_EQ(highest(peaks), 500e9) << "three more measurements at most";
    EXPECT_EQ(bench::peak_warnings(peaks),
              std::vector<std::string>{"peak: openmp 0, float: one of 5 measurements reached 500.0 GFLOP/s, all others "
                                       "stay below 95 %"});
}

}  // namespace
}  // namespace mandelmarch
