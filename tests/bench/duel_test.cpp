// SPDX-License-Identifier: Apache-2.0
// Verdicts on synthetic duels with known differences.
#include "bench/contest/duel.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "made.h"

namespace mandelmarch::bench {
namespace {

constexpr int rows = 8;

// Disturbances on a synthetic machine. The first three are standard deviations of logarithms of times.
struct Noise {
    double run = 0.01;      // of a program in a run, for example because of its memory layout
    double moment = 0.20;   // of a pair of pictures, the same for both
    double picture = 0.02;  // of a single picture
    double hit = 0.05;      // fraction of pictures that take twice as long, because of an interruption
};
constexpr Noise quiet{.run = 0.002, .moment = 0.1, .picture = 0.002, .hit = 0};
constexpr Noise loaded{.run = 0.03, .moment = 0.5, .picture = 0.08, .hit = 0.2};

// Returns a duel in which row i takes factor(i) times as long with the new program as with the old one.
Duel made_duel(std::mt19937_64& random, const std::function<double(int)>& factor, const Noise& noise = {},
               int runs = 10)
{
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> any;
    Duel duel{.runs = runs, .rounds = 20};
    for (int i = 0; i < rows; ++i) {
        DuelRow row{.name = fmt::format("row{}", i)};
        for (int run = 0; run < runs; ++run) {
            const double old_speed = 0.1 * std::exp(noise.run * normal(random));
            const double new_speed = 0.1 * factor(i) * std::exp(noise.run * normal(random));
            for (int round = 0; round < duel.rounds; ++round) {
                const double moment = std::exp(noise.moment * normal(random));
                const auto picture = [&](double speed) {
                    return moment * speed * std::exp(noise.picture * normal(random)) *
                           (any(random) < noise.hit ? 2 : 1);
                };
                row.pairs.push_back({run, round, picture(old_speed), picture(new_speed)});
            }
        }
        duel.rows.push_back(row);
    }
    return duel;
}

double all_slower(int) { return 1.03; }

using Alarm = std::function<bool(const Duel&)>;

int alarms(const std::function<double(int)>& factor, const Noise& noise, const Alarm& alarm, int of = 400)
{
    std::mt19937_64 random(9);
    int count = 0;
    for (int i = 0; i < of; ++i) count += alarm(made_duel(random, factor, noise)) ? 1 : 0;
    return count;
}

bool judge_alarms(const Duel& duel) { return called(judged(duel).verdicts) > 0; }

TEST(Duel, EqualProgramsRaiseAtMostOneAlarmInTwenty)
{
    EXPECT_LE(alarms(same, {}, judge_alarms), 20) << "of 400";
    EXPECT_LE(alarms(same, loaded, judge_alarms), 20) << "of 400, under load";
}

// Negative controls: with each of these simpler methods there are many false alarms.
TEST(Duel, ShortcutsRaiseMany)
{
    const auto pairs_as_units = [](const Duel& duel) {
        std::vector<double> p;
        for (const DuelRow& row : duel.rows) {
            std::vector<double> ratios;
            for (const DuelPair& pair : row.pairs) ratios.push_back(pair.new_seconds / pair.old_seconds);
            p.push_back(paired_difference(ratios, duel.margin).p);
        }
        return any_significant(p);
    };
    const Noise quiet_pictures{.run = 0.03, .moment = 0.1, .picture = 0.01, .hit = 0};
    EXPECT_GT(alarms(same, quiet_pictures, pairs_as_units), 100) << "pairs of one run taken for independent";
    const auto uncorrected = [](const Duel& duel) {
        const Duel found = judged(duel);
        return std::ranges::any_of(found.verdicts, [&](const Judged& row) {
            return row.name != all_rows && (row.difference.interval.low > 1 || row.difference.interval.high < 1);
        });
    };
    EXPECT_GT(alarms(same, {}, uncorrected), 100) << "each row by itself, without a margin";
}

TEST(Duel, FindsThreePercentInNineOfTen)
{
    EXPECT_GE(alarms(all_slower, {}, judge_alarms), 360) << "of 400";
    // If runs differ less, a single slower row is found, too.
    const auto third = [](const Duel& duel) { return judged(duel).verdicts.at(3).verdict == Verdict::slower; };
    EXPECT_GE(alarms([](int i) { return i == 3 ? 1.03 : 1.0; }, {.run = 0.005}, third), 360) << "of 400";
}

// Negative control: `bench compare` does not use the pairs, and finds no difference in the times of the same pictures.
TEST(Duel, WithoutPairsTheSamePicturesSayNothing)
{
    const auto unpaired = [](const Duel& duel) {
        std::vector<double> p;
        for (const DuelRow& row : duel.rows) {
            ValuesByRun before;
            ValuesByRun after;
            for (const DuelPair& pair : row.pairs) {
                before[pair.run].push_back(pair.old_seconds);
                after[pair.run].push_back(pair.new_seconds);
            }
            p.push_back(difference(medians_of(before), medians_of(after), margin).p);
        }
        return any_significant(p);
    };
    EXPECT_LT(alarms(all_slower, {}, unpaired), 100) << "of 400";
}

TEST(Duel, EachVerdict)
{
    std::mt19937_64 random(4);
    Duel duel = made_duel(
        random, [](int i) { return i == 0   ? 1.05
                                   : i == 1 ? 0.95
                                            : 1.0; }, quiet);
    // Row 2 is slower in half of the runs and faster in the others.
    for (DuelPair& pair : duel.rows[2].pairs) pair.new_seconds *= pair.run % 2 == 0 ? 1.1 : 0.9;
    duel.rows[4].new_failure = "the picture is wrong";
    duel.rows[4].pairs.clear();
    duel.rows[5].old_failure = "there is no such row";
    duel.rows[6].pairs[7].old_seconds = 0;
    const std::vector<Judged> verdicts = judged(duel).verdicts;
    ASSERT_EQ(verdicts.size(), 9U);
    EXPECT_EQ(verdicts[0].verdict, Verdict::slower);
    EXPECT_NEAR(verdicts[0].difference.ratio, 1.05, 0.01);
    EXPECT_EQ(verdicts[1].verdict, Verdict::faster);
    EXPECT_EQ(verdicts[2].verdict, Verdict::undecided);
    EXPECT_EQ(verdicts[3].verdict, Verdict::same);
    EXPECT_EQ(verdicts[4].verdict, Verdict::wrong);
    EXPECT_EQ(verdicts[4].why, "new: the picture is wrong");
    EXPECT_EQ(verdicts[5].verdict, Verdict::no_speed);
    EXPECT_EQ(verdicts[6].why, "a time is not above 0");
    EXPECT_EQ(verdicts[8].name, all_rows);
    EXPECT_TRUE(regression(verdicts));
}

TEST(Duel, TheMarginIsWhatIsAskedFor)
{
    std::mt19937_64 random(4);
    Duel duel = made_duel(random, all_slower, quiet);
    EXPECT_EQ(judged(duel).verdicts[0].verdict, Verdict::slower);
    duel.margin = 0.06;
    EXPECT_EQ(judged(duel).verdicts[0].verdict, Verdict::same);
}

TEST(Duel, TheTableSaysWhatDiffers)
{
    std::mt19937_64 random(4);
    Duel duel = made_duel(random, same);
    duel.old_side.environment = {{"build", {{"flags", "-O3"}}}};
    duel.new_side.environment = {{"build", {{"flags", "-O2"}}}};
    duel.warnings = {"load: much"};
    duel.rows[0].same_picture = false;
    const std::string text = to_console(judged(duel));
    EXPECT_NE(text.find("differs: compiler flags: -O3 in the old result, -O2 in the new\n"), std::string::npos) << text;
    EXPECT_NE(text.find("warning: load: much\n"), std::string::npos);
    EXPECT_NE(text.find("another picture\n"), std::string::npos);
}

}  // namespace
}  // namespace mandelmarch::bench
