// SPDX-License-Identifier: Apache-2.0
// Quantiles without interpolation: each result is one of the values. There must be at least one value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace mandelmarch {

// Returns the value with the index `rank` in the sorted values; 0 is the index of the smallest.
template <class Values>
auto value_of_rank(Values values, std::size_t rank)
{
    const auto at = std::begin(values) + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(values, at);
    return *at;
}

// Returns the value that the given share of the other values, from 0 to 1, does not exceed. If no value fits exactly,
// returns the next lower one.
template <class Values>
auto quantile(const Values& values, double share)
{
    return value_of_rank(values, static_cast<std::size_t>(share * static_cast<double>(std::size(values) - 1)));
}

// Returns the median. If the number of values is even, returns the upper one of the two values in the middle.
template <class Values>
auto upper_median(const Values& values)
{
    return value_of_rank(values, std::size(values) / 2);
}

}  // namespace mandelmarch
