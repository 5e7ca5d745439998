// SPDX-License-Identifier: Apache-2.0
// Tells platforms of several results apart that have one name but are different machines.
#pragma once

#include <span>
#include <vector>

#include "bench/result.h"

namespace mandelmarch::bench {

// Maximum factor between peaks of one platform, each the highest of many runs.
inline constexpr double same_peak = 1.5;

// Returns the results, with platforms of one name renamed if they differ: CPUs in stepping, flags, caches or usable
// cores, as far as both results have them; any device in its measured peak, by more than the factor same_peak. CPUs of
// one boot of one system are one machine, whatever their peaks. The machine's number, from 1, is appended: "AMD EPYC
// (family 26 model 2), machine 2".
std::vector<Result> disambiguated(std::span<const Result> results);

}  // namespace mandelmarch::bench
