// SPDX-License-Identifier: Apache-2.0
// The statistics of the harness, each explained where it is computed (statistics.cpp) and in docs/method.md.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace mandelmarch::bench {

inline constexpr double confidence = 0.95;  // of every interval

struct Interval {
    double low = 0, high = 0;
};

// Numbers by the launch, the process that is, that measured them.
using Launches = std::map<int, std::vector<double>>;

// The summary of at least one number. A single number has the deviation 0 and no interval.
struct Summary {
    int count = 0;
    int launches = 0;  // that the numbers come from
    double median = 0;
    double mad = 0;  // median absolute deviation from the median, not scaled
    double least = 0, most = 0;
    // One launch: the interval of the median from order statistics, at least 95 %; nullopt below six numbers. Several
    // launches: launch_interval() of their medians, widened to hold the median of all numbers.
    std::optional<Interval> interval;

    // Half the interval's width, relative to the median; nullopt where there is no interval.
    std::optional<double> half_width() const;
};

// 0 for no numbers.
double median(std::vector<double> values);

// The summary of independent numbers: those of one launch.
Summary summary(std::span<const double> values);

// The summary of numbers from several launches. All numbers of one launch share that launch's error.
Summary summary(const Launches& launches);

// The 95 % interval of what a launch finds on average, from what each found (its median): Student's t of their
// logarithms, with as many degrees of freedom as there are launches beyond the first. nullopt below two launches, or
// where a value is not above 0.
std::optional<Interval> launch_interval(std::span<const double> medians);

// The medians of the launches, in their order.
std::vector<double> medians_of(const Launches& launches);

// The medians of groups of at least three consecutive rounds of one launch, so that one disturbed picture does not
// change a verdict. Empty for fewer than three numbers.
inline constexpr std::size_t group_size = 3;
std::vector<double> group_medians(std::span<const double> values);

// The interval of the median from order statistics: the k-th smallest to the k-th largest of n numbers, with the
// largest k for which the interval covers the median with probability 0.95 whatever the distribution. nullopt where
// even the smallest and largest do not (n < 6).
std::optional<Interval> median_interval(std::span<const double> values);

// Welch's test of two sets of logarithms (two numbers at least in each): how sure is it that they differ by more than a
// margin?
struct Difference {
    double ratio = 1;    // of the geometric means, new / old
    Interval interval;   // of the ratio, 95 %, this pair alone
    double p = 1;        // of a ratio at least as far from 1, if the true one were within the margin
    double degrees = 0;  // of freedom
};

// `margin`: a true ratio between 1 / (1 + margin) and 1 + margin is no difference. All values must be above 0.
Difference difference(std::span<const double> old_values, std::span<const double> new_values, double margin);

// The same of ratios that are one each from a launch of both (two at least, all above 0): Student's test of their
// logarithms.
Difference paired_difference(std::span<const double> ratios, double margin);

// How many times as long one thing takes as another, from times of both in the same launches.
struct Quotient {
    double ratio = 1;                  // of the medians of all times
    std::optional<Interval> interval;  // 95 %, holds the ratio
};

// Takes times of both, at least one of each, in the order of the rounds. If several launches have both, the interval is
// launch_interval() of the launches' ratios of medians; else median_interval() of the ratios of the rounds.
Quotient quotient(const Launches& numerator, const Launches& denominator);

// The contribution of one sampled block to two sums.
struct Part {
    double part = 0, whole = 0;
};

struct PartRatio {
    std::optional<double> ratio;  // of the sums; nullopt where the whole is 0
    // If only one block contributes to the whole, its variance is unknown, and this is the ratio itself.
    double standard_error = 0;
};

// The ratio estimated from a stratified sample: one block from each stratum, in the order of the strata.
PartRatio ratio_of_sums(std::span<const Part> blocks);

// Holm's correction: each p raised so that calling what is below 0.05 raises a false alarm anywhere with probability
// 0.05 at most. In the order given.
std::vector<double> holm(std::span<const double> p);

}  // namespace mandelmarch::bench
