// SPDX-License-Identifier: Apache-2.0
// Measures the multiply-add peak of a device: the highest rate at which it runs core/kernel/peak.h.
#pragma once

#include <functional>

namespace mandelmarch {

// Operations that an iteration of multiply_add_chains executes on each lane: 40 multiply-adds of two operations.
inline constexpr double peak_operations_per_round = 80;
// The arguments a and b of multiply_add_chains.
inline constexpr double peak_factor = 0.5;
inline constexpr double peak_addend = 1;

// Runs multiply_add_chains on all lanes of the device, with `rounds` iterations. Returns the time in seconds.
using PeakRun = std::function<double(int rounds)>;

// Returns the highest rate of several runs of at least 20 ms each, in operations per second. The highest is used
// because disturbances only make a run slower. `lanes`: number of lanes of the device that a run uses.
double highest_rate(const PeakRun& run, double lanes);

}  // namespace mandelmarch
