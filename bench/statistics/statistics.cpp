// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics/statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace mandelmarch::bench {
namespace {

// Tests whether a ratio differs from 1 by more than the margin. `shift`: the difference of the means of the logarithms.
Difference tested(const Moments& shift, double margin)
{
    const double within = std::log1p(margin);
    Difference d;
    d.ratio = std::exp(shift.mean);
    d.degrees = shift.degrees;
    if (!(shift.variance_of_mean > 0)) {
        // All values are equal: the result is certain.
        d.interval = {d.ratio, d.ratio};
        d.p = std::abs(shift.mean) > within ? 0 : 1;
        return d;
    }
    const boost::math::students_t distribution(d.degrees);
    const double error = std::sqrt(shift.variance_of_mean);
    const double reach = quantile(distribution, (1 + confidence) / 2) * error;
    d.interval = {std::exp(shift.mean - reach), std::exp(shift.mean + reach)};
    if (std::abs(shift.mean) > within) {
        d.p = cdf(complement(distribution, (std::abs(shift.mean) - within) / error)) +
              cdf(complement(distribution, (std::abs(shift.mean) + within) / error));
    }
    return d;
}

bool all_positive(std::span<const double> values)
{
    return std::ranges::all_of(values, [](double value) { return value > 0; });
}

std::vector<double> together(const ValuesByRun& runs)
{
    std::vector<double> all;
    for (const auto& [run, values] : runs) all.insert(all.end(), values.begin(), values.end());
    return all;
}

// Widens the interval so that it contains the value. The value is a median, but the interval may be that of a mean of
// logarithms, which need not contain the median.
std::optional<Interval> holding(std::optional<Interval> interval, double value)
{
    if (!interval) return interval;
    return Interval{std::min(interval->low, value), std::max(interval->high, value)};
}

}  // namespace

Moments moments(std::span<const double> values)
{
    const auto n = static_cast<double>(values.size());
    double sum = 0;
    for (const double value : values) sum += std::log(value);
    Moments m{.mean = sum / n, .degrees = n - 1};
    double squares = 0;
    for (const double value : values) squares += (std::log(value) - m.mean) * (std::log(value) - m.mean);
    m.variance_of_mean = squares / (n - 1) / n;
    return m;
}

std::optional<double> Summary::half_width() const
{
    if (!interval || median <= 0) return std::nullopt;
    return (interval->high - interval->low) / 2 / median;
}

double median(std::vector<double> values)
{
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    if (values.size() % 2 == 1) return *middle;
    return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

// Each of the n values is below the true median with probability 1/2. The interval from the k-th smallest to the k-th
// largest value misses the median if fewer than k values are below the median, or fewer than k are above it. These two
// events have the same probability, a sum of binomial probabilities (Conover, Practical Nonparametric Statistics, 3.2).
std::optional<Interval> median_interval(std::span<const double> values)
{
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const std::size_t n = sorted.size();
    double probability = std::pow(0.5, static_cast<double>(n));  // that exactly j values are below the median
    double below = 0;
    std::size_t k = 0;
    for (std::size_t j = 0; j < n; ++j) {
        below += probability;
        if (below > (1 - confidence) / 2) break;
        k = j + 1;
        probability *= static_cast<double>(n - j) / static_cast<double>(j + 1);
    }
    if (k == 0) return std::nullopt;
    return Interval{sorted[k - 1], sorted[n - k]};
}

Summary summary(std::span<const double> values)
{
    Summary s;
    s.count = static_cast<int>(values.size());
    if (values.empty()) return s;
    s.runs = 1;
    s.median = median({values.begin(), values.end()});
    std::vector<double> deviations;
    for (const double value : values) deviations.push_back(std::abs(value - s.median));
    s.mad = median(std::move(deviations));
    s.min = *std::ranges::min_element(values);
    s.max = *std::ranges::max_element(values);
    s.interval = median_interval(values);
    return s;
}

std::vector<double> medians_of(const ValuesByRun& runs)
{
    std::vector<double> medians;
    medians.reserve(runs.size());
    for (const auto& [run, values] : runs) medians.push_back(median(values));
    return medians;
}

std::vector<double> group_medians(std::span<const double> values)
{
    const std::size_t groups = values.size() / group_size;
    std::vector<double> medians;
    for (std::size_t i = 0; i < groups; ++i) {
        const std::size_t first = i * values.size() / groups;
        const std::span group = values.subspan(first, (i + 1) * values.size() / groups - first);
        medians.push_back(median({group.begin(), group.end()}));
    }
    return medians;
}

// This is the top level of the method of Kalibera and Jones ("Rigorous benchmarking in reasonable time", ISMM 2013,
// section 9.3). The scatter of the runs' medians contains all differences between runs. Therefore the interval is
// computed from the medians alone; additional samples within a run only make its median more precise. The computation
// uses logarithms, because disturbances multiply times.
std::optional<Interval> run_interval(std::span<const double> medians)
{
    if (medians.size() < 2 || !all_positive(medians)) return std::nullopt;
    return tested(moments(medians), 0).interval;
}

Summary summary(const ValuesByRun& runs)
{
    const std::vector<double> medians = medians_of(runs);
    Summary s = summary(together(runs));
    s.runs = static_cast<int>(medians.size());
    if (s.runs > 1) s.interval = holding(run_interval(medians), s.median);
    return s;
}

Quotient quotient(const ValuesByRun& numerator, const ValuesByRun& denominator)
{
    const std::vector<double> above = together(numerator);
    const std::vector<double> below = together(denominator);
    Quotient q;
    q.ratio = median(above) / median(below);
    if (!all_positive(above) || !all_positive(below)) return q;
    std::vector<double> ratios;
    for (const auto& [run, values] : numerator) {
        const auto same = denominator.find(run);
        if (same != denominator.end()) ratios.push_back(median(values) / median(same->second));
    }
    if (ratios.size() > 1) {
        q.interval = holding(run_interval(ratios), q.ratio);
    } else {
        std::vector<double> by_round;
        for (std::size_t i = 0; i < std::min(above.size(), below.size()); ++i) by_round.push_back(above[i] / below[i]);
        q.interval = holding(median_interval(by_round), q.ratio);
    }
    return q;
}

// Welch's test (Biometrika 34, 1947) of the difference of two means whose variances may be unequal. The null hypothesis
// is not that the means are equal, but that their difference is within the margin. Therefore p is computed for a true
// difference at the margin's edge, where p is largest.
Difference difference(std::span<const double> old_values, std::span<const double> new_values, double margin)
{
    const Moments a = moments(old_values);
    const Moments b = moments(new_values);
    const double variance = a.variance_of_mean + b.variance_of_mean;
    const double degrees = variance > 0 ? variance * variance /
                                              (a.variance_of_mean * a.variance_of_mean / a.degrees +
                                               b.variance_of_mean * b.variance_of_mean / b.degrees)
                                        : a.degrees + b.degrees;
    return tested({.mean = b.mean - a.mean, .variance_of_mean = variance, .degrees = degrees}, margin);
}

Difference paired_difference(std::span<const double> ratios, double margin) { return tested(moments(ratios), margin); }

// Holm (Scandinavian Journal of Statistics 6, 1979): the smallest of m p-values is multiplied by m, the next by m - 1,
// and so on. A product smaller than the one before is raised to it.
std::vector<double> holm(std::span<const double> p)
{
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
    std::vector<double> adjusted(p.size());
    double largest = 0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const double raised = std::min(1.0, p[order[rank]] * static_cast<double>(p.size() - rank));
        largest = std::max(largest, raised);
        adjusted[order[rank]] = largest;
    }
    return adjusted;
}

}  // namespace mandelmarch::bench
