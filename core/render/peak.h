// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of a device: the highest rate of core/kernel/peak.h.
#pragma once

#include <functional>

namespace mandelmarch {

// Operations per lane of one loop iteration of multiply_add_chains: 40 multiply-adds, two operations each.
inline constexpr double peak_operations_per_round = 80;
// Arguments of the chains.
inline constexpr double peak_factor = 0.5;
inline constexpr double peak_addend = 1;

// Runs the chains on the whole device, `rounds` iterations on every lane. Returns the time in seconds.
using PeakRun = std::function<double(int rounds)>;

// Returns the highest rate of several runs of at least 20 ms, in operations per second: disturbances only make a run
// slower. `lanes`: all lanes of the device that a run uses.
double highest_rate(const PeakRun& run, double lanes);

}  // namespace mandelmarch
