// SPDX-License-Identifier: Apache-2.0
// Distinguishes platforms of several results that have the same name but are different machines.
#pragma once

#include <span>
#include <vector>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Maximum ratio of the peaks that two results have for one platform. Each peak is the highest of many measurements.
inline constexpr double same_peak = 1.5;

// Returns the results with distinct names for platforms that have one name but differ. Two platforms differ if
//   - they are CPUs with another stepping, other flags, caches or usable cores. A fact that only one result has is
//     ignored; or
//   - their measured peaks differ by more than the factor same_peak. The peaks of CPUs are not compared if both results
//     are from the same boot of one system.
// The machine's number, from 1, is then appended to the name: "AMD EPYC (family 26 model 2), machine 2".
std::vector<Result> disambiguated(std::span<const Result> results);

}  // namespace mandelmarch::bench
