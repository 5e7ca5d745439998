// SPDX-License-Identifier: Apache-2.0
// Result of a study: plain data, as passed to the output formats and stored in JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/counting/counting.h"
#include "bench/statistics/statistics.h"
#include "core/render/backend.h"

namespace mandelmarch::bench {

inline constexpr const char* result_schema = "mandelmarch-bench";
// The study that compares backends and includes the baselines.
inline constexpr std::string_view standard_study = "standard";
inline constexpr std::string_view demo_study = "demo";  // a short study, with the same baselines
// The study in which each configuration of a fractal changes one thing in the configuration before it, and is compared
// with that configuration.
inline constexpr std::string_view ladder_study = "ladder";

// Times of one picture in the timed rounds, in seconds.
struct Sample {
    int run = 0;                                            // index of the run
    int round = 0;                                          // index within that run
    double kernel = 0, wall = 0, upload = 0, readback = 0;  // seconds, as in Timings
    double host = 0;
    double trial = 0;
    std::optional<double> joules{};  // mean energy for a picture (bench/measure/telemetry.h); nullopt: unknown

    // Adds the times of a picture.
    void add(const Timings& t)
    {
        kernel += t.kernel;
        wall += t.wall;
        upload += t.upload;
        readback += t.readback;
        host += t.host;
        trial += t.trial;
    }
};

// The scene of a picture, and its size.
struct Picture {
    int width = 0, height = 0;      // pixels
    int iterations = 0;             // maximum of DE iterations, n
    double detail = 0;              // detail level, D
    double power = 0;               // third value of the parameter file's line 7
    std::string view = "official";  // name of the scene
    bool operator==(const Picture&) const = default;
};

// Parameters of a configuration besides fractal, precision, mode, backend and device.
struct Setting : Picture {
    int threads = 0, simd_width = 0, chunk = 0, band = 0, block_size = 0,
        resident_warps = 0;  // see RendererOptions; 0: automatic
    std::string without;     // disabled optimisations, as in `render --without`
    int frames = 0;          // pictures per sample, from a fresh renderer; 0: one picture, from a warm renderer
    bool operator==(const Setting&) const = default;

    const Picture& picture() const { return *this; }
};

// Comparison of the configuration's picture with the expected one.
struct Verification {
    bool drawn = false;  // a picture was rendered
    bool passed = false;
    bool is_expected = false;  // the configuration renders the expected picture itself
    std::string level;         // name_of(Level); "expected picture" for the expected picture itself
    std::string text;          // the result, for the table: "same bits", "3 ULP", "0.193 % off"
    std::string against;       // name of the expected picture
    std::uint64_t pixels = 0, differing = 0, visibly_differing = 0;
    double max_ulps = 0;  // infinite if a value is not a number
    double psnr = 0;      // dB
};

// Quantities shown in the tables, computed from the samples by derived() (bench/result/figures.h).
struct Figures {
    Summary kernel, wall;                                  // seconds
    double upload = 0, readback = 0, host = 0, trial = 0;  // seconds, medians
    // Fraction of the wall time that upload, host and readback leave unaccounted for; median over the samples. Absent
    // if a sample consists of several pictures from a fresh renderer, because its wall time then has further parts.
    std::optional<double> unaccounted;
    std::optional<double> joules;  // energy of a picture, mean over the samples
    // Per second of kernel time without the trial: pixels, DE evaluations, DE iterations, counted operations.
    double pixel_rate = 0, estimate_rate = 0, iteration_rate = 0;
    std::optional<double> operation_rate;
    std::optional<double> peak;   // the platform's peak in this precision, operations per second
    std::optional<double> share;  // operation_rate / peak
    std::optional<double> bound;  // seconds that the counted operations take at the peak
    // Wall time of the reference, in double and exact mode, for the same picture / this configuration's wall time. For
    // the reference itself: 1, without an interval.
    std::optional<Quotient> speed_up;
    // Wall time of the scalar kernel on the host's threads, in the same setting, precision and mode / this
    // configuration's wall time. Absent for the scalar kernel itself.
    std::optional<Quotient> over_scalar;
};

struct Row {
    std::string fractal;  // name; "all" in the only row of a backend without a device
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    std::string backend;
    int device = 0;           // index
    std::string sweep_value;  // "threads=2"; empty in the standard study
    Setting setting;

    std::string unavailable;  // the reason why the configuration cannot be measured; else empty
    std::string failure;      // a description of the failure; else empty
    std::string device_name, vendor, driver, instruction_set;
    std::string platform;  // the GPU's name, or Cpu::platform() for every device that runs on the CPU
    bool is_gpu = false;
    int threads = 0, simd_width = 0;  // the numbers that were used
    Verification verification;
    double context = 0, build = 0;  // seconds, of the first picture
    // Results of the trial before the verified picture (see RenderStats); both 0 if there was no trial.
    double step_factor = 0, unsettled = 0;
    Work work;              // of one picture
    double operations = 0;  // of one picture, from the counting kernel; 0: unknown
    std::vector<Sample> samples;
    // Name under which the configuration is compared; set by derived(). It is the name of the backend, but
    // "openmp-scalar" for the scalar kernel in the studies standard and demo, which also contain openmp's packs.
    std::string application;
    std::optional<Figures> figures;  // set by derived(); nullopt without a speed

    // Returns "mandelbulb/double/exact/openmp/0", followed by "/threads=2" in a sweep; "vulkan" for a backend without a
    // device.
    std::string name() const;
    // Returns true if the picture was verified and timed, so that there is a speed to show.
    bool timed() const { return unavailable.empty() && failure.empty() && verification.passed && !samples.empty(); }
    bool failed() const
    {
        return unavailable.empty() && (!failure.empty() || (verification.drawn && !verification.passed));
    }
};

struct Peak {
    std::string platform;
    std::string backend;
    int device = 0;
    Precision precision = Precision::f64;
    double rate = 0;  // operations per second

    bool same_device(const Peak& other) const
    {
        return platform == other.platform && backend == other.backend && device == other.device &&
               precision == other.precision;
    }
};

// Merges `from` into `to`: adds the peaks that `to` does not have, and raises the others to the higher rate.
void raise_peaks(std::vector<Peak>& to, const std::vector<Peak>& from);

// Counted operations of the kernel, for one fractal, precision, mode and setting.
struct Counted : Count {
    std::string fractal;
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    Setting setting;
};

// Ratio of two configurations' kernel times, paired by run and round to cancel disturbances of a whole round.
struct Ratio {
    std::string numerator, denominator;  // names of the configurations
    Summary ratio;                       // summary of the pairs' ratios; its count is 0 if there is no pair
};

// The ratios that answer the questions of a study. Each vector has all pairs of configurations that were timed.
struct Questions {
    std::vector<Ratio> box_to_bulb;        // Mandelbox / Mandelbulb, on the same device
    std::vector<Ratio> double_to_float;    // double / float, on the same device
    std::vector<Ratio> others_to_host;     // each other backend except the reference / the host's backend
    std::vector<Ratio> to_first_value;     // sweeps, ladder: each later value / the first value
    std::vector<Ratio> to_previous_value;  // sweeps, ladder: each value / the last earlier one of the same aspect ratio
};

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON does not throw, which the check cannot see
struct Result {
    std::string study;
    std::uint64_t seed = 0;
    int runs = 1;            // number of runs that left samples
    bool moved_eye = false;  // each round had other views (bench/measure/moving_eye.h)
    nlohmann::ordered_json environment = nlohmann::ordered_json::object();
    std::vector<std::string> warnings;
    std::vector<Peak> peaks;
    std::vector<Counted> counts;
    std::vector<Row> rows;
    Questions questions;  // set by derived()

    bool failed() const;
    // Returns the name of the backend with the role of the reference.
    std::string reference() const;
    // Returns the name of the backend with the role of the host.
    std::string host() const;
    // Returns the configuration with this name, which must exist.
    const Row& row(std::string_view name) const;
};

}  // namespace mandelmarch::bench
