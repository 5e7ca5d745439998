// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace mandelmarch::bench {
namespace {

struct Moments {
    double mean = 0;
    double variance_of_mean = 0;
    double degrees = 0;
};

// Of the logarithms: times are positive and their disturbances multiply.
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

}  // namespace

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

// The median lies above the k-th smallest of n numbers unless fewer than k of them fell below it, and each falls below
// with probability 1/2: P(below k) is a sum of binomial probabilities. By symmetry the interval from the k-th smallest
// to the k-th largest misses the median with twice that (Conover, Practical Nonparametric Statistics, 3.2).
std::optional<Interval> median_interval(std::span<const double> values)
{
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const std::size_t n = sorted.size();
    double probability = std::pow(0.5, static_cast<double>(n));  // of exactly j numbers below the median
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
    s.median = median({values.begin(), values.end()});
    std::vector<double> deviations;
    for (const double value : values) deviations.push_back(std::abs(value - s.median));
    s.mad = median(std::move(deviations));
    s.least = *std::ranges::min_element(values);
    s.most = *std::ranges::max_element(values);
    s.interval = median_interval(values);
    return s;
}

// Welch (Biometrika 34, 1947): the difference of two means, with variances that need not be equal. The null hypothesis
// is not "equal" but "within the margin": p is taken at the margin's edge, where it is largest.
Difference difference(std::span<const double> old_values, std::span<const double> new_values, double margin)
{
    const Moments a = moments(old_values);
    const Moments b = moments(new_values);
    const double shift = b.mean - a.mean;
    const double variance = a.variance_of_mean + b.variance_of_mean;
    const double within = std::log1p(margin);
    Difference d;
    d.ratio = std::exp(shift);
    if (!(variance > 0)) {
        // Every number equal: a difference is certain, or there is none.
        d.interval = {d.ratio, d.ratio};
        d.degrees = a.degrees + b.degrees;
        d.p = std::abs(shift) > within ? 0 : 1;
        return d;
    }
    d.degrees =
        variance * variance /
        (a.variance_of_mean * a.variance_of_mean / a.degrees + b.variance_of_mean * b.variance_of_mean / b.degrees);
    const boost::math::students_t distribution(d.degrees);
    const double error = std::sqrt(variance);
    const double reach = quantile(distribution, (1 + confidence) / 2) * error;
    d.interval = {std::exp(shift - reach), std::exp(shift + reach)};
    if (std::abs(shift) > within) {
        d.p = cdf(complement(distribution, (std::abs(shift) - within) / error)) +
              cdf(complement(distribution, (std::abs(shift) + within) / error));
    }
    return d;
}

// Holm (Scandinavian Journal of Statistics 6, 1979): the smallest of m p-values is multiplied by m, the next by m - 1,
// and so on; none may come out below the one before.
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
