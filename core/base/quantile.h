// SPDX-License-Identifier: Apache-2.0
// Quantiles that are one of the values, without interpolation. There must be a value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace mandelmarch {

// Returns the value that has `rank` smaller ones.
template <class Values>
auto value_of_rank(Values values, std::size_t rank)
{
    const auto at = std::begin(values) + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(values, at);
    return *at;
}

// Returns the value that has the given share of the others, from 0 to 1, below it; the lower one of two.
template <class Values>
auto quantile(const Values& values, double share)
{
    return value_of_rank(values, static_cast<std::size_t>(share * static_cast<double>(std::size(values) - 1)));
}

// Returns the median, the upper one of two.
template <class Values>
auto upper_median(const Values& values)
{
    return value_of_rank(values, std::size(values) / 2);
}

}  // namespace mandelmarch
