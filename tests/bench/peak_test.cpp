// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of made devices, whose rate is known and whose runs are disturbed.
#include "core/render/peak.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mandelmarch {
namespace {

constexpr double seconds_per_round = 1e-7;
constexpr double start_seconds = 1e-5;  // of every run
constexpr double lanes = 16;
constexpr double true_rate = peak_operations_per_round * lanes / seconds_per_round;

// A device whose runs, counted from 0, are longer by what `disturbance` says. Seconds.
PeakRun device(const std::function<double(int run)>& disturbance)
{
    return [=, run = 0](int rounds) mutable { return start_seconds + rounds * seconds_per_round + disturbance(run++); };
}

// Every run among the first 20 disturbed by itself, for the worst of the measured rates.
double worst_rate(const std::function<double(const PeakRun&)>& measured)
{
    double worst = true_rate;
    for (int one = 0; one < 20; ++one) {
        worst = std::min(worst, measured(device([=](int run) { return run == one ? 0.05 : 0; })));
    }
    return worst;
}

// The twin: the rounds are fixed by the first run that is long enough, and nobody looks again.
double calibrated_on_one_run(const PeakRun& run)
{
    int rounds = 256;
    run(rounds);
    double seconds = run(rounds);
    for (; seconds < 0.02; seconds = run(rounds)) rounds *= 8;
    for (int i = 0; i < 8; ++i) seconds = std::min(seconds, run(rounds));
    return peak_operations_per_round * rounds * lanes / seconds;
}

TEST(Peak, OneDisturbedRunDoesNotMoveIt)
{
    EXPECT_NEAR(worst_rate([](const PeakRun& run) { return highest_rate(run, lanes); }) / true_rate, 1, 0.001);
    EXPECT_LT(worst_rate(calibrated_on_one_run) / true_rate, 0.8) << "the twin must show that a disturbance matters";
}

TEST(Peak, AMachineThatIsBusyMostOfTheTimeIsMeasuredInItsQuietRuns)
{
    const PeakRun busy = device([](int run) { return run % 4 == 3 ? 0 : 0.03; });
    EXPECT_NEAR(highest_rate(busy, lanes) / true_rate, 1, 0.001);
}

TEST(Peak, ARunWithoutATimeEndsAndHasNoRate)
{
    EXPECT_EQ(highest_rate([](int) { return 0.0; }, lanes), 0);
}

TEST(Peak, ADeviceThatIsTooFastForTheClockIsGivenTheMostRounds)
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

}  // namespace
}  // namespace mandelmarch
