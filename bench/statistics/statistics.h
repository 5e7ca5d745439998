// SPDX-License-Identifier: Apache-2.0
// Statistics of bench. Each method is explained in statistics.cpp and in docs/method.md.
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

// Values, grouped by the index of the run that measured them. A run is one process.
using ValuesByRun = std::map<int, std::vector<double>>;

// Summary of at least one value. A single value has the deviation 0 and no interval.
struct Summary {
    int count = 0;
    int runs = 0;  // number of runs that the values come from
    double median = 0;
    double mad = 0;  // median absolute deviation from the median, not scaled
    double min = 0, max = 0;
    // If the values come from one run: median_interval(), or nullopt for fewer than six values. If they come from
    // several runs: run_interval() of the runs' medians, widened so that it contains the median of all values.
    std::optional<Interval> interval;

    // Returns half the interval's width, relative to the median; nullopt if there is no interval.
    std::optional<double> half_width() const;
};

// Returns the median; 0 if there are no values.
double median(std::vector<double> values);

// Summarises the values of a single run, as independent values.
Summary summary(std::span<const double> values);

// Summarises values from several runs. Values of the same run share that run's error, so they are not independent.
Summary summary(const ValuesByRun& runs);

// Returns the 95 % interval of the geometric mean over all possible runs. `medians`: the median of each run. The
// interval is computed with Student's t from the logarithms of the medians; the number of degrees of freedom is the
// number of runs minus one. Returns nullopt if there are fewer than two runs, or if a median is not above 0.
std::optional<Interval> run_interval(std::span<const double> medians);

// Moments of the logarithms of values, which are above 0. Logarithms are used because disturbances multiply times.
struct Moments {
    double mean = 0;
    double variance_of_mean = 0;
    double degrees = 0;  // degrees of freedom
};
Moments moments(std::span<const double> values);

// Returns the median of each run, in the order of the runs.
std::vector<double> medians_of(const ValuesByRun& runs);

// Divides the values, from consecutive rounds of one run, into groups of at least three, and returns the median of each
// group. Such medians are compared instead of single values, so that one disturbed picture does not change a verdict.
// Returns an empty list for fewer than three values.
inline constexpr std::size_t group_size = 3;
std::vector<double> group_medians(std::span<const double> values);

// Returns the interval of the median from order statistics: from the k-th smallest to the k-th largest of n values. k
// is the largest number for which the interval contains the true median with a probability of at least 0.95, for any
// distribution. Returns nullopt if even the smallest and the largest value do not suffice (n < 6).
std::optional<Interval> median_interval(std::span<const double> values);

// Result of a test that finds out whether two sets of values differ by more than a margin.
struct Difference {
    double ratio = 1;    // ratio of the geometric means, new / old
    Interval interval;   // 95 % interval of the ratio, not corrected for other tests
    double p = 1;        // max probability of a ratio at least this far from 1 if the true one is within the margin
    double degrees = 0;  // degrees of freedom
};

// Applies Welch's test to the logarithms of two sets of values. Each set has at least two values; all are above 0.
// `margin`: a true ratio between 1 / (1 + margin) and 1 + margin does not count as a difference.
Difference difference(std::span<const double> old_values, std::span<const double> new_values, double margin);

// Applies Student's test to the logarithms of at least two ratios above 0: one from each run that measured both sides
// of the comparison.
Difference paired_difference(std::span<const double> ratios, double margin);

// Ratio of two sets of times that were measured in the same runs.
struct Quotient {
    double ratio = 1;                  // ratio of the medians of all times
    std::optional<Interval> interval;  // 95 %; contains the ratio
};

// Returns the quotient of two sets of times. Each set has at least one time, and the times of a run are in the order of
// its rounds. If the sets have several runs in common, each of these runs gives a ratio: its median in one set over
// that in the other. The interval is run_interval() of these ratios. Otherwise it is median_interval() of the ratios of
// the two times in each round.
Quotient quotient(const ValuesByRun& numerator, const ValuesByRun& denominator);

// Returns the p-values after Holm's correction, in the given order. If all corrected values up to 0.05 are called
// significant, the probability of at least one false alarm is at most 0.05.
std::vector<double> holm(std::span<const double> p);

}  // namespace mandelmarch::bench
