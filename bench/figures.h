// SPDX-License-Identifier: Apache-2.0
// The figures of the tables, derived from a result's raw samples.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/result.h"
#include "bench/statistics.h"

namespace mandelmarch::bench {

// The settings draw the same scene at the same size.
bool same_picture(const Setting& a, const Setting& b);

// The samples' kernel or wall times, in seconds; per picture.
std::vector<double> kernel_times(const Row& row);
std::vector<double> wall_times(const Row& row);
// The same by launch.
Launches kernel_launches(const Row& row);
Launches wall_launches(const Row& row);
// The medians of the kernel times of each launch, in the launches' order.
std::vector<double> launch_medians(const Row& row);

struct Figures {
    Summary kernel, wall;                       // seconds
    double upload = 0, readback = 0, host = 0;  // seconds, medians
    // The share of the wall time that upload, host and readback leave, the median of the samples; not of rows whose
    // wall time has more parts: those of several pictures from a fresh renderer.
    std::optional<double> unaccounted;
    double pixel_rate = 0;                         // pixels per second of kernel time
    double estimate_rate = 0, iteration_rate = 0;  // per second of kernel time
    std::optional<double> operation_rate;          // operations per second, from counted work
    std::optional<double> peak;                    // operations per second, of the row's platform and precision
    std::optional<double> share;                   // operation_rate / peak
    std::optional<double> share_error;             // its standard error that comes from the operations' alone
    std::optional<double> bound;                   // seconds: the counted work at that peak
    // Wall time of `reference` (double, exact, same setting) / this row's wall time. For the reference itself it is 1,
    // without an interval.
    std::optional<Quotient> speed_up;
    // Wall time of the same text as scalar C++ on the host's threads (same setting, precision and mode) / this row's
    // wall time. The scalar row itself has none.
    std::optional<Quotient> over_scalar;
};

// The figures of a timed row.
Figures figures_of(const Result& result, const Row& row);

// The row is the text as scalar C++, pixel by pixel: the backend of the host's cores with packs of one pixel.
bool is_scalar(const Result& result, const Row& row);

// The name under which a row is compared with others: that of its backend; but in the standard study the scalar text,
// which stands beside the same backend's packs, is called "openmp-scalar".
std::string application_of(const Result& result, const Row& row);

// True if `counted` is the text that the row runs.
bool is_counted_for(const Counted& counted, const Row& row);

// The highest rate that any backend reached on the platform; nullptr if none was measured.
const Peak* peak_of(const Result& result, const std::string& platform, Precision precision);

// A ratio of two rows' kernel times, paired by launch and round, so that what slows a whole round down cancels.
struct Ratio {
    const Row* numerator;
    const Row* denominator;
    Summary summary;  // of the pairs' ratios, by launch; count 0 where the rows share no round
};

// The pairs' ratios, by launch. Times of the denominator that are not above 0 are left out.
Launches ratios_by_launch(const Row& numerator, const Row& denominator);

// The fractals of the study box-vs-bulb and of the question that it is about.
inline constexpr std::string_view box = "mandelbox";
inline constexpr std::string_view bulb = "mandelbulb";

// The three questions. Mandelbox / Mandelbulb, for every backend, device, precision and mode; double / float, for every
// fractal, backend, device and mode; another backend of the text / the host's, for every device, fractal, precision and
// mode. Only rows that are timed.
std::vector<Ratio> box_to_bulb(const Result& result);
std::vector<Ratio> double_to_float(const Result& result);
std::vector<Ratio> others_to_host(const Result& result);

// Ratios within a sweep, whose rows differ only in their point: each later point / the first point, and each later
// point / the last timed point before it whose picture has the same shape.
std::vector<Ratio> to_first_point(const Result& result);
std::vector<Ratio> to_previous_point(const Result& result);

}  // namespace mandelmarch::bench
