// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of a device: the most that core/kernel/peak.h reaches on it.
#pragma once

#include <functional>

namespace mandelmarch {

// Operations of one round of multiply_add_chains on one lane: 40 multiply-adds, two operations each.
inline constexpr double peak_operations_per_round = 80;
// What the chains are given.
inline constexpr double peak_factor = 0.5;
inline constexpr double peak_addend = 1;

// Runs the chains on a whole device, `rounds` rounds on every lane, and returns the seconds that it took.
using PeakRun = std::function<double(int rounds)>;

// Operations per second, the highest of several runs of 20 ms at least, the fastest included: what disturbs a run only
// makes it slower. `lanes` is the number of lanes that a run keeps busy, on the whole device.
double highest_rate(const PeakRun& run, double lanes);

}  // namespace mandelmarch
