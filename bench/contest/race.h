// SPDX-License-Identifier: Apache-2.0
// bench race: compares the times of other programs, which read a parameter file and write a picture, with the times of
// our `render`.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/base/statistics.h"
#include "core/render/registry.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {

enum class RaceVerdict {
    same,        // all bytes of the picture are as expected
    close,       // at most 2 % of the pixels differ visibly
    wrong,       // more than 2 % of the pixels differ visibly
    wrong_size,  // the picture has another size
    no_picture,  // exit code 0, but no output file
    no_image,    // the output file is not a picture
    unsteady,    // the first picture was correct, but a later one was wrong
    failed,      // exit code other than 0
    crashed,     // ended by a signal
    hung,        // killed at the time limit
    no_start     // the system cannot run the program
};
std::string_view name_of(RaceVerdict verdict);

// Returns true if the picture is correct, so that the program's speed counts.
constexpr bool is_right(RaceVerdict verdict) { return verdict == RaceVerdict::same || verdict == RaceVerdict::close; }

// Comparison of a program's picture with that of our scalar kernel, in exact mode and double.
struct RacePicture {
    int width = 0, height = 0;
    std::uint64_t differing = 0;          // pixels with any byte different
    std::uint64_t visibly_differing = 0;  // pixels with a byte off by more than 2 of 255
    int first_x = -1, first_y = -1;       // first differing pixel, from the bottom left; -1: none
    double psnr = 0;                      // dB; +infinity for identical bytes
};

struct RaceSample {
    int round = 0;
    double seconds = 0, processor = 0;  // of the whole process: wall time, and processor time of all threads
};

struct RacedProgram {
    std::string name;
    bool ours = false;
    RaceVerdict verdict = RaceVerdict::no_start;
    std::string why{};  // the reason if the verdict is neither same nor close; else empty
    std::optional<int> exit_code{}, signal{};
    std::optional<RacePicture> picture{};  // nullopt unless the picture has the right size
    std::uint64_t memory = 0;              // peak resident bytes of the program's largest process
    std::vector<RaceSample> samples{};     // empty unless all pictures are correct
    // Set by timed().
    std::optional<Summary> wall{};         // seconds
    std::optional<Quotient> times_ours{};  // this program's wall time / that of our first program
};

struct Race {
    nlohmann::ordered_json environment = nlohmann::ordered_json::object();
    std::string fractal;
    int width = 0, height = 0;
    std::string parameters;  // contents of the parameter file
    double limit = 0;        // seconds
    int rounds = 0;
    std::vector<std::string> warnings{};
    std::vector<RacedProgram> racers{};  // ours first

    // Returns true if every program's picture is correct.
    bool passed() const;
};

// Summarises the times of each program with correct pictures, and compares them with those of our first program.
Race timed(Race race);

std::string to_console(const Race& race);

// Returns what a file holds.
nlohmann::ordered_json facts_of(const Race& race);

struct RaceOptions {
    std::vector<std::string> programs;        // paths
    const Fractal* fractal = nullptr;         // nullptr: the first of fractals()
    std::string scene;                        // a parameter file; empty: the fractal's official scene
    std::optional<std::pair<int, int>> size;  // pixels; nullopt: as in `scene` or, if that is empty, 540 x 540
    std::string backend = "openmp";           // the backend that our renderer uses
    std::uint64_t seed = 1;                   // for the order of the programs in each round
    double limit = 60;                        // seconds per picture
    int rounds = 7;
};

// Runs each program as `PROGRAM scene.dat` in a folder that contains only this parameter file. The file tells the
// program to write the picture image.bmp. This picture is compared with that of our scalar kernel in double and exact
// mode. Programs with a correct picture are then timed as whole processes, together with our `render` on
// options.backend, in several rounds, each in random order. Each round has its own view of the scene, so that a picture
// kept from an earlier run would be wrong; the pictures of the rounds must be correct, too. If a program's first run
// took more than longest_repeated, that run is its only sample. `progress` receives the completed fraction, 0 to 1.
// Throws InputError if a program is not an executable file or the scene cannot be read, and Error if our own picture
// cannot be rendered.
inline constexpr double longest_repeated = 20;  // seconds
Race run_race(const RaceOptions& options, const Registry& registry, const std::function<void(double)>& progress);

}  // namespace mandelmarch::bench
