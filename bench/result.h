// SPDX-License-Identifier: Apache-2.0
// Result of a study: plain data, as passed to the output formats and stored in JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/counting.h"
#include "core/render/backend.h"

namespace mandelmarch::bench {

inline constexpr int schema_version = 1;
// The study that compares backends and includes the baselines.
inline constexpr std::string_view standard_study = "standard";

// Times of one picture in the timed rounds, in seconds.
struct Sample {
    int launch = 0;                                         // index of the run
    int round = 0;                                          // index within that run
    double kernel = 0, wall = 0, upload = 0, readback = 0;  // seconds, as in Timings
    double host = 0;
    double processor = 0;  // of all threads of the rendering process; for duels, not stored
};

// Parameters of a configuration besides fractal, precision, mode, backend and device.
struct Setting {
    int width = 0, height = 0;                                  // pixels
    int iterations = 0;                                         // maximum of DE iterations, n
    double detail = 0;                                          // detail level, D
    double power = 0;                                           // third value of the parameter file's line 7
    int threads = 0, pack = 0, chunk = 0, band = 0, block = 0;  // as in RendererOptions; 0: automatic
    std::string without{};                                      // disabled optimisations, as in `render --without`
    std::string view = "official";                              // name of the scene
    int frames = 0;  // pictures per sample, from a fresh renderer; 0: one picture, from a warm renderer
};

// Comparison of the configuration's picture with the expected one.
struct Proof {
    bool drawn = false;  // a picture was rendered
    bool passed = false;
    bool yardstick = false;  // the configuration renders the expected picture itself
    std::string level;       // name_of(Level)
    std::string text;        // for the table: "same bits", "3 ULP", "0.193 % off"
    std::string against;     // name of the expected picture
    std::uint64_t pixels = 0, differing = 0, visibly_differing = 0;
    double largest_ulps = 0;
    double psnr = 0;  // dB
};

struct Row {
    std::string fractal;  // name; "all" in the one row of a backend without a device
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    std::string backend;
    int device = 0;     // index
    std::string point;  // sweep value, "threads=2"; empty in the standard study
    Setting setting;

    std::string unavailable;  // why it cannot be measured; else empty
    std::string failure;      // what went wrong; else empty
    std::string device_name, vendor, driver, instruction_set;
    std::string platform;  // the GPU's name, or Cpu::platform() for every device that runs on the CPU
    bool is_gpu = false;
    int threads = 0, pack = 0;  // actually used
    Proof proof;
    double context = 0, build = 0;  // seconds, of the first picture
    // Results of the trial before the verified picture (see RenderStats); both 0 if there was no trial.
    double step_factor = 0, unsettled = 0;
    Work work;              // of one picture
    double operations = 0;  // of one picture, from the counting kernel; 0: unknown
    // Standard error of `operations`, which are counted on a sample of the pixels; unknown in results of older builds.
    std::optional<double> operations_error;
    std::vector<Sample> samples;

    // Returns "mandelbulb/double/exact/openmp/0", followed by "/threads=2" in a sweep; "vulkan" for a backend without a
    // device.
    std::string name() const;
    // Returns true if the picture was verified and timed, so that there is a speed to show.
    bool timed() const { return unavailable.empty() && failure.empty() && proof.passed && !samples.empty(); }
    bool failed() const { return unavailable.empty() && (!failure.empty() || (proof.drawn && !proof.passed)); }
};

struct Peak {
    std::string platform;
    std::string backend;
    int device = 0;
    Precision precision = Precision::f64;
    double rate = 0;  // operations per second
};

// Merges `from` into `to`: adds the peaks that `to` does not have, and raises the others to the higher rate.
void raise_peaks(std::vector<Peak>& to, const std::vector<Peak>& from);

// Operation counts of the kernel, for one fractal, precision, mode and setting.
struct Counted {
    std::string fractal;
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    Setting setting;
    Count count;
};

// Time of one stage of a picture, in the study profile.
struct StageTime {
    std::string fractal;
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    std::string stage;
    std::vector<double> seconds;  // one per repetition
};

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON does not throw, which the check cannot see
struct Result {
    std::string study;
    std::uint64_t seed = 0;
    int launches = 1;  // number of runs that left samples
    nlohmann::ordered_json environment;
    std::vector<std::string> warnings;
    std::vector<Peak> peaks;
    std::vector<Counted> counts;
    std::vector<StageTime> stages;
    std::vector<Row> rows;

    bool failed() const;
    // Returns the name of the backend with the role of the reference.
    std::string reference() const;
    // Returns the name of the backend with the role of the host.
    std::string host() const;
};

}  // namespace mandelmarch::bench
