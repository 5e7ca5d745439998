// SPDX-License-Identifier: Apache-2.0
// Performance portability: the metric of Pennycook, Sewall and Lee ("A Metric for Performance Portability", PMBS 2016;
// "Implications of a metric for performance portability", Future Generation Computer Systems 92, 2019).
//
// Here an application is a backend, a platform is a device, and a problem is a fractal at one size, in one precision
// and mode. An application with the efficiencies e_i on the platforms of a set H has the performance portability
//   PP = |H| / sum of 1 / e_i   if every platform of H is supported, else 0.
// An application's H holds the platforms of all results, except those on which the application was not measured.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/result/result.h"
#include "bench/statistics/statistics.h"

namespace mandelmarch::bench {

// Returns the harmonic mean of the efficiencies; 0 if one of them is 0 (unsupported) or the list is empty.
double performance_portability(std::span<const double> efficiencies);

// An application on one platform. Both efficiencies are 0 if the application is not supported there or its picture is
// wrong.
struct OnPlatform {
    std::string platform;
    double seconds = 0;      // median kernel time
    double application = 0;  // application efficiency: best time of any backend on the platform / this time
    // Architectural efficiency: the share of the multiply-add peak; empty: the peak was not measured.
    std::optional<double> architecture = 0;
};

// A step of a cascade. A cascade adds one platform after the other, in the order of falling application efficiency.
// `portability` is computed over this platform and the platforms before it (Sewall, Pennycook and others, "Interpreting
// and visualizing performance portability metrics", P3HPC 2020).
struct CascadeStep {
    std::string platform;
    double efficiency = 0;
    double portability = 0;
};

struct Portability {
    std::string problem;  // "mandelbulb 540x540"
    std::string fractal;
    int width = 0, height = 0;  // pixels
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    std::string application;            // backend
    std::vector<OnPlatform> platforms;  // H
    // Platforms that occur only in results without this application; not in H.
    std::vector<std::string> not_measured;
    double application_portability = 0;
    Interval application_interval;                       // 95 %, from resampled times, as is the other interval
    std::optional<double> architecture_portability = 0;  // empty: the peak of a supported platform was not measured
    std::optional<Interval> architecture_interval;
    std::vector<CascadeStep> cascade;
};

// Computes the metric for each problem and application, over the platforms of all results, after disambiguated().
// Configurations of sweeps and of the scalar kernel are left out, as are those of the reference, which is not an
// application. If a backend has several devices on one platform, the fastest counts.
//
// An application counts as unsupported on a platform if a result contains the application and the platform, but no
// correct picture of this application on this platform: it is unavailable there, its picture is wrong, or it ran only
// on other platforms of the result. If an application was measured on no platform for a problem, its H is empty.
std::vector<Portability> portability(std::span<const Result> given);

// Returns JSON of the entries whose H is not empty.
nlohmann::ordered_json json_of(const std::vector<Portability>& portabilities);

// Returns CSV with one line for each problem, each application, and each platform on which the application runs. The
// first four columns are those that p3-analysis-library reads: problem, application, platform and fom (pixels per
// second of kernel time, higher is better). The column h has the platforms of the application's H, separated by "; ".
// The library takes a missing line to mean that the application does not run on the platform, even if the platform is
// not in h.
std::string to_csv(const std::vector<Portability>& portabilities);

// Returns the table of `bench portability`.
std::string to_console(const std::vector<Portability>& portabilities);

}  // namespace mandelmarch::bench
