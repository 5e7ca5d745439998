// SPDX-License-Identifier: Apache-2.0
// The statistics of the harness, each explained where it is computed (statistics.cpp) and in docs/benchmarking.md.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace mandelmarch::bench {

inline constexpr double confidence = 0.95;  // of every interval

struct Interval {
    double low = 0, high = 0;
};

// Of at least one number. A single number has the deviation 0 and no interval.
struct Summary {
    int count = 0;
    double median = 0;
    double mad = 0;  // median absolute deviation from the median, not scaled
    double least = 0, most = 0;
    std::optional<Interval> interval;  // of the median, at least 95 %; nullopt below six numbers

    // Half the interval's width, relative to the median; nullopt where there is no interval.
    std::optional<double> half_width() const;
};

// 0 for no numbers.
double median(std::vector<double> values);

Summary summary(std::span<const double> values);

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

// Holm's correction: each p raised so that calling what is below 0.05 raises a false alarm anywhere with probability
// 0.05 at most. In the order given.
std::vector<double> holm(std::span<const double> p);

}  // namespace mandelmarch::bench
