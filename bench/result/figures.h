// SPDX-License-Identifier: Apache-2.0
// Quantities shown in the tables, computed from a result's samples.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/result/result.h"
#include "bench/statistics/statistics.h"

namespace mandelmarch::bench {

// Returns the samples' kernel times, in seconds per picture.
std::vector<double> kernel_times(const Row& row);
// Return the samples' kernel or wall times, in seconds per picture, grouped by run.
ValuesByRun kernel_runs(const Row& row);
ValuesByRun wall_runs(const Row& row);
// Returns the median kernel time of each run, in the order of the runs.
std::vector<double> run_medians(const Row& row);

// Returns the result with the members set that follow from its samples: Row::application and Row::figures of all
// configurations, and Result::questions.
Result derived(Result result);

// Returns true if the configuration is the scalar kernel: the host's backend with a SIMD width of 1.
bool is_scalar(const Result& result, const Row& row);

// Returns true if `counted` holds the operation counts of the configuration's picture.
bool is_counted_for(const Counted& counted, const Row& row);

// Returns the highest peak that any backend reached on the platform in this precision; nullptr if none was measured.
const Peak* peak_of(const Result& result, const std::string& platform, Precision precision);

// Returns, for each run, the ratios of the two configurations' kernel times in the rounds that both have. Rounds in
// which the denominator's time is not above 0 are left out.
ValuesByRun ratios_by_run(const Row& numerator, const Row& denominator);

// The fractals whose kernel times Questions::box_to_bulb compares.
inline constexpr std::string_view box = "mandelbox";
inline constexpr std::string_view bulb = "mandelbulb";

}  // namespace mandelmarch::bench
