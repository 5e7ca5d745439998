// SPDX-License-Identifier: Apache-2.0
// Figures of the tables, derived from a result's samples.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/result.h"
#include "bench/statistics.h"

namespace mandelmarch::bench {

// Returns true if both settings draw the same scene at the same size.
bool same_picture(const Setting& a, const Setting& b);

// Return the samples' kernel or wall times, in seconds per picture.
std::vector<double> kernel_times(const Row& row);
std::vector<double> wall_times(const Row& row);
// Return the same, grouped by run.
Launches kernel_launches(const Row& row);
Launches wall_launches(const Row& row);
// Returns the median kernel time of each run, in the order of the runs.
std::vector<double> launch_medians(const Row& row);

struct Figures {
    Summary kernel, wall;                       // seconds
    double upload = 0, readback = 0, host = 0;  // seconds, medians
    // Fraction of the wall time outside upload, host and readback; median over the samples. Absent for configurations
    // that render several pictures from a fresh renderer, whose wall time has more parts.
    std::optional<double> unaccounted;
    double pixel_rate = 0;                         // pixels per second of kernel time
    double estimate_rate = 0, iteration_rate = 0;  // per second of kernel time
    std::optional<double> operation_rate;          // operations per second, from the counted work
    std::optional<double> peak;                    // operations per second, of the platform in this precision
    std::optional<double> share;                   // operation_rate / peak
    std::optional<double> share_error;             // its standard error due to the operation count alone
    std::optional<double> bound;                   // seconds: counted work / peak
    // Wall time of `reference` (double, exact, same setting) / this configuration's wall time; 1 without an interval
    // for the reference itself.
    std::optional<Quotient> speed_up;
    // Wall time of the scalar kernel on the host's threads (same setting, precision and mode) / this configuration's
    // wall time. Absent for the scalar configuration.
    std::optional<Quotient> over_scalar;
};

// Returns the figures of a timed configuration.
Figures figures_of(const Result& result, const Row& row);

// Returns true if the configuration is the scalar kernel: the host backend with packs of one pixel.
bool is_scalar(const Result& result, const Row& row);

// Returns the name under which a configuration is compared: its backend's name, but "openmp-scalar" for the scalar
// kernel in the standard study, which has the same backend's packs, too.
std::string application_of(const Result& result, const Row& row);

// Returns true if `counted` is the kernel that the configuration runs.
bool is_counted_for(const Counted& counted, const Row& row);

// Returns the highest rate that any backend reached on the platform; nullptr if none was measured.
const Peak* peak_of(const Result& result, const std::string& platform, Precision precision);

// Ratio of two configurations' kernel times, paired by run and round to cancel disturbances of a whole round.
struct Ratio {
    const Row* numerator;
    const Row* denominator;
    Summary summary;  // of the pairs' ratios, by run; count 0 without a common round
};

// Returns the pairs' ratios, by run. Pairs whose denominator is not above 0 are left out.
Launches ratios_by_launch(const Row& numerator, const Row& denominator);

// Fractals of the study box-vs-bulb.
inline constexpr std::string_view box = "mandelbox";
inline constexpr std::string_view bulb = "mandelbulb";

// Ratios of timed configurations: Mandelbox / Mandelbulb for every backend, device, precision and mode; double / float
// for every fractal, backend, device and mode; another backend of the kernel / the host's backend for every device,
// fractal, precision and mode.
std::vector<Ratio> box_to_bulb(const Result& result);
std::vector<Ratio> double_to_float(const Result& result);
std::vector<Ratio> others_to_host(const Result& result);

// Ratios within a sweep, whose configurations differ only in the sweep value: each later value / the first one, and
// each later value / the last timed value before it with the same shape of picture.
std::vector<Ratio> to_first_point(const Result& result);
std::vector<Ratio> to_previous_point(const Result& result);

}  // namespace mandelmarch::bench
