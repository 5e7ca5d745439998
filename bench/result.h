// SPDX-License-Identifier: Apache-2.0
// What a study found: plain data, as the reporters take it and the JSON file keeps it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/counting.h"
#include "core/render/backend.h"

namespace mandelmarch::bench {

inline constexpr int schema_version = 1;
// The study that compares backends, and has the rows that others are compared with.
inline constexpr std::string_view standard_study = "standard";

// One picture of the timed rounds. Seconds.
struct Sample {
    int launch = 0;                                         // which process took it
    int round = 0;                                          // in which round of that process
    double kernel = 0, wall = 0, upload = 0, readback = 0;  // seconds, as in Timings
    double host = 0;
    double processor = 0;  // of all threads of the process that drew it; for duels, in no file
};

// What was asked of a row beside fractal, precision, mode, backend and device.
struct Setting {
    int width = 0, height = 0;                                  // pixels
    int iterations = 0;                                         // n
    double detail = 0;                                          // D
    double power = 0;                                           // third value of line 7
    int threads = 0, pack = 0, chunk = 0, band = 0, block = 0;  // as in RendererOptions; 0: the backend's choice
    std::string without{};          // techniques that are switched off, as in --without of the renderers
    std::string view = "official";  // which scene: its name
    int frames = 0;                 // pictures from a fresh renderer in one sample; 0: one, from a warm renderer
};

// How the row's picture compares with the one that it should be.
struct Proof {
    bool drawn = false;  // there was a picture to compare
    bool fine = false;
    bool yardstick = false;  // the row draws what others are compared with
    std::string level;       // name_of(Level)
    std::string text;        // for the table: "same bits", "3 ULP", "0.193 % off"
    std::string against;     // what it was compared with
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
    std::string point;  // what a sweep varies, "threads=2"; empty in the standard study
    Setting setting;

    std::string unavailable;  // why there is no such row; empty if there is
    std::string failure;      // what went wrong; empty if nothing did
    std::string device_name, vendor, driver, instruction_set;
    std::string platform;  // the GPU's name, or Cpu::platform() for every device that runs on the CPU
    bool is_gpu = false;
    int threads = 0, pack = 0;  // that really ran
    Proof proof;
    double context = 0, build = 0;  // seconds, of the first picture
    // Of the proven picture's trial (RenderReport); 0 and 0 without one.
    double stride = 0, unsettled = 0;
    Work work;              // of one picture
    double operations = 0;  // of one picture, from the counted text; 0: not known
    // Its standard error, as operations are counted on a sample of the pixels; unknown in results of older builds.
    std::optional<double> operations_error;
    std::vector<Sample> samples;

    // "mandelbulb/double/exact/openmp/0", and "/threads=2" behind it in a sweep; "vulkan" for a backend without a
    // device.
    std::string name() const;
    // There is a speed to show.
    bool timed() const { return unavailable.empty() && failure.empty() && proof.fine && !samples.empty(); }
    bool failed() const { return unavailable.empty() && (!failure.empty() || (proof.drawn && !proof.fine)); }
};

struct Peak {
    std::string platform;
    std::string backend;
    int device = 0;
    Precision precision = Precision::f64;
    double rate = 0;  // operations per second
};

// Takes those of new devices, and of known ones the greater rate.
void raise_peaks(std::vector<Peak>& to, const std::vector<Peak>& from);

// What the text of one fractal does, counted.
struct Counted {
    std::string fractal;
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    Setting setting;
    Count count;
};

// Seconds that one stage of a picture takes, in the profile.
struct StageTime {
    std::string fractal;
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    std::string stage;
    std::vector<double> seconds;  // one for each repetition
};

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON does not throw, which the check cannot see
struct Result {
    std::string study;
    std::uint64_t seed = 0;
    int launches = 1;  // that left samples
    nlohmann::ordered_json environment;
    std::vector<std::string> warnings;
    std::vector<Peak> peaks;
    std::vector<Counted> counts;
    std::vector<StageTime> stages;
    std::vector<Row> rows;

    bool failed() const;
    // The name of the backend that has the role of the reference.
    std::string reference() const;
    // Of the backend that runs the text on the host's cores.
    std::string host() const;
};

}  // namespace mandelmarch::bench
