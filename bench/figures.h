// SPDX-License-Identifier: Apache-2.0
// Quantities shown in the tables, computed from a result's samples.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/result.h"
#include "bench/statistics.h"

namespace mandelmarch::bench {

// Returns true if both settings give the same scene at the same size.
bool same_picture(const Setting& a, const Setting& b);

// Return the samples' kernel or wall times, in seconds per picture.
std::vector<double> kernel_times(const Row& row);
std::vector<double> wall_times(const Row& row);
// Return the samples' kernel or wall times, in seconds per picture, grouped by run.
Launches kernel_launches(const Row& row);
Launches wall_launches(const Row& row);
// Returns the median kernel time of each run, in the order of the runs.
std::vector<double> launch_medians(const Row& row);

struct Figures {
    Summary kernel, wall;                       // seconds
    double upload = 0, readback = 0, host = 0;  // seconds, medians
    // Fraction of the wall time that upload, host and readback leave unaccounted for; median over the samples. Absent
    // if a sample consists of several pictures from a fresh renderer, as its wall time then has further parts.
    std::optional<double> unaccounted;
    double pixel_rate = 0;                         // pixels per second of kernel time
    double estimate_rate = 0, iteration_rate = 0;  // per second of kernel time
    std::optional<double> operation_rate;          // operations per second, from the counted work
    std::optional<double> peak;                    // operations per second, of the platform in this precision
    std::optional<double> share;                   // operation_rate / peak
    std::optional<double> share_error;             // standard error of `share` that the sampled operation count causes
    std::optional<double> bound;                   // seconds that the counted operations take at the peak
    // Wall time of the reference, in double and exact mode, for the same picture / this configuration's wall time. For
    // the reference itself: 1, without an interval.
    std::optional<Quotient> speed_up;
    // Wall time of the scalar kernel on the host's threads, in the same setting, precision and mode / this
    // configuration's wall time. Absent for the scalar kernel itself.
    std::optional<Quotient> over_scalar;
};

// Computes the quantities of a timed configuration.
Figures figures_of(const Result& result, const Row& row);

// Returns true if the configuration is the scalar kernel: the host backend with packs of one pixel.
bool is_scalar(const Result& result, const Row& row);

// Returns the name under which a configuration is compared: the name of its backend. The standard study contains both
// the packs of openmp and its scalar kernel; there the scalar kernel is called "openmp-scalar".
std::string application_of(const Result& result, const Row& row);

// Returns true if `counted` holds the operation counts of the configuration's picture.
bool is_counted_for(const Counted& counted, const Row& row);

// Returns the highest peak that any backend reached on the platform in this precision; nullptr if none was measured.
const Peak* peak_of(const Result& result, const std::string& platform, Precision precision);

// Ratio of two configurations' kernel times, paired by run and round to cancel disturbances of a whole round.
struct Ratio {
    const Row* numerator;
    const Row* denominator;
    Summary summary;  // of the pairs' ratios, by run; count 0 without a common round
};

// Returns, for each run, the ratios of the kernel times that both configurations have in the same round. Rounds in
// which the denominator's time is not above 0 are left out.
Launches ratios_by_launch(const Row& numerator, const Row& denominator);

// Fractals of the study box-vs-bulb.
inline constexpr std::string_view box = "mandelbox";
inline constexpr std::string_view bulb = "mandelbulb";

// Returns Mandelbox / Mandelbulb, for every backend, device, precision and mode that was timed.
std::vector<Ratio> box_to_bulb(const Result& result);
// Returns double / float, for every fractal, backend, device and mode that was timed.
std::vector<Ratio> double_to_float(const Result& result);
// Returns each other backend / the backend with the role host, for every device, fractal, precision and mode that was
// timed. The reference is left out.
std::vector<Ratio> others_to_host(const Result& result);

// Return ratios of configurations that differ only in their sweep value.
// to_first_point(): each later value / the first value.
// to_previous_point(): each later value / the last timed value before it whose picture has the same aspect ratio.
std::vector<Ratio> to_first_point(const Result& result);
std::vector<Ratio> to_previous_point(const Result& result);

}  // namespace mandelmarch::bench
