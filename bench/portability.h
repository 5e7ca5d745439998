// SPDX-License-Identifier: Apache-2.0
// Performance portability: the metric of Pennycook, Sewall and Lee ("A Metric for Performance Portability", PMBS 2016;
// "Implications of a metric for performance portability", Future Generation Computer Systems 92, 2019).
//
// An application here is a backend, a platform a device, a problem a fractal at a size, in one precision and mode. For
// the platforms of a set H with the efficiencies e_i of one application:
//   PP = |H| / sum of 1 / e_i   if every platform of H is supported, else 0.
// An application's H holds the platforms of all results, except those on which it was not measured.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/result.h"
#include "bench/statistics.h"

namespace mandelmarch::bench {

// Returns the harmonic mean of the efficiencies; 0 if one is 0 (unsupported) or there are none.
double performance_portability(std::span<const double> efficiencies);

// The application on one platform. Efficiencies are 0 if it is unsupported or its picture is wrong.
struct OnPlatform {
    std::string platform;
    double seconds = 0;       // median kernel time
    double application = 0;   // application efficiency: best time of any backend on the platform / this time
    double architecture = 0;  // architectural efficiency: share of the measured multiply-add peak
};

// One platform, in order of falling application efficiency, and the portability over the platforms up to it (Sewall,
// Pennycook and others, "Interpreting and visualizing performance portability metrics", P3HPC 2020).
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
    double application_portability = 0, architecture_portability = 0;
    Interval application_interval, architecture_interval;  // 95 %, from resampled times
    std::vector<CascadeStep> cascade;
};

// Computes the metric over all platforms of all results, after disambiguated(). Configurations of sweeps, of the scalar
// kernel and of the reference, which is not an application, are left out. If a backend runs on a platform as several
// devices, the fastest counts. An application does not support a platform if a result has both but no correct picture:
// the application is unavailable there, its picture is wrong, or it ran only on other platforms of that result. An
// application that was measured nowhere for a problem has an empty H.
std::vector<Portability> portability(std::span<const Result> given);

// Returns the entries whose H is not empty.
nlohmann::ordered_json json_of(const std::vector<Portability>& portabilities);

// Returns the columns problem, application, platform and fom (pixels per second of kernel time, higher is better), as
// read by p3-analysis-library, and h, the application's H, separated by "; ". There is one line for each application
// and each platform it runs on. The library takes a missing line to mean that the platform is unsupported, even if h
// does not contain it.
std::string to_csv(const std::vector<Portability>& portabilities);

// Returns the table of `bench portability`.
std::string to_console(const std::vector<Portability>& portabilities);

}  // namespace mandelmarch::bench
