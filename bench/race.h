// SPDX-License-Identifier: Apache-2.0
// bench race: programs that read a parameter file and write a picture, beside ours.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mandelmarch::bench {

enum class RaceVerdict {
    same,        // every byte of the picture
    close,       // at most 2 % of the pixels are visibly off
    wrong,       // more are
    wrong_size,  // the picture has another size
    no_picture,  // it ended well and left none
    no_image,    // what it left is no picture
    unsteady,    // a later picture was wrong
    failed,      // an exit code other than 0
    crashed,     // ended by a signal
    hung,        // ended at the time limit
    no_start     // the system does not run it
};
std::string_view name_of(RaceVerdict verdict);

// There is a speed to show.
constexpr bool is_right(RaceVerdict verdict) { return verdict == RaceVerdict::same || verdict == RaceVerdict::close; }

// The picture beside the one of our scalar text, in exact mode and double.
struct RacePicture {
    int width = 0, height = 0;
    std::uint64_t differing = 0;          // pixels with any byte different
    std::uint64_t visibly_differing = 0;  // pixels with a byte off by more than 2 of 255
    int first_x = -1, first_y = -1;       // of those that differ, from the bottom left; -1: none does
    double psnr = 0;                      // dB; +infinity for the same bytes
};

struct RaceSample {
    int round = 0;
    double seconds = 0, processor = 0;  // of the whole process: wall, and of all its threads
};

struct Racer {
    std::string name;
    bool ours = false;
    RaceVerdict verdict = RaceVerdict::no_start;
    std::string why{};  // in words, where there is no speed
    std::optional<int> exit_code{}, signal{};
    std::optional<RacePicture> picture{};  // where it has the right size
    std::uint64_t memory = 0;              // bytes resident at most
    std::vector<RaceSample> samples{};     // of programs whose picture is right
};

struct Race {
    nlohmann::ordered_json environment = nlohmann::ordered_json::object();
    std::string fractal;
    int width = 0, height = 0;
    std::string parameters;  // the text of the parameter file
    double limit = 0;        // seconds
    int rounds = 0;
    std::vector<std::string> warnings{};
    std::vector<Racer> racers{};  // ours first

    // Every program's picture is right.
    bool held() const;
};

std::string to_console(const Race& race);

// As bench/schemas/race.schema.json says.
nlohmann::ordered_json json_of(const Race& race);

}  // namespace mandelmarch::bench
