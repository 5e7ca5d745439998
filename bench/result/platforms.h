// SPDX-License-Identifier: Apache-2.0
// Distinguishes different machines whose platforms have the same name in several results.
#pragma once

#include <span>
#include <vector>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Maximum ratio of the peaks that two results have for the same machine. Each peak is the highest of many measurements.
inline constexpr double same_peak = 1.5;

// Returns the results. If platforms with the same name are different machines, appends the machine's number, from 1, to
// the name: "AMD EPYC (family 26 model 2), machine 2". Two platforms are different machines if
//   - they are CPUs that differ in stepping, flags, caches or usable cores. A fact that only one result has is ignored;
//     or
//   - their measured peaks differ by more than the factor same_peak. The peaks of CPUs are not compared if both results
//     are from the same boot of one system.
std::vector<Result> disambiguated(std::span<const Result> results);

}  // namespace mandelmarch::bench
