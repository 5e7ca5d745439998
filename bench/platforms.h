// SPDX-License-Identifier: Apache-2.0
// Platforms of several results: those of one name that are not the same machine get names of their own.
#pragma once

#include <span>
#include <vector>

#include "bench/result.h"

namespace mandelmarch::bench {

// Peaks of one platform, each the highest of many runs, agree within this factor.
inline constexpr double same_peak = 1.5;

// The results, with platforms renamed where two of one name differ: a CPU in its stepping, flags, caches or usable
// cores, as far as both results know them, or any device in its measured peak, by more than the factor same_peak. CPUs
// of one boot of one system are one machine, whatever load did to their peaks. Their names have the number of the
// machine behind them, from 1: "AMD EPYC (family 26 model 2), machine 2".
std::vector<Result> told_apart(std::span<const Result> results);

}  // namespace mandelmarch::bench
