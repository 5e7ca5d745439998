// SPDX-License-Identifier: Apache-2.0
// `bench random`: compares fast mode's pictures of random scenes with canonical pictures.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/render/registry.h"
#include "core/scene/scene.h"

namespace mandelmarch::bench {

struct RandomOptions {
    std::string backend = {};  // name; empty: the host's backend
    std::vector<const Fractal*> fractals{};
    int scenes = 60;                                                 // per fractal and set
    std::vector<unsigned> sets{1001, 2002, 3003, 4004, 5005, 6006};  // seeds
    std::string without{};                                           // disabled optimisations, separated by commas
};

// Result of one scene in one precision.
struct RandomRow {
    std::string fractal;  // short name
    Precision precision = Precision::f64;
    unsigned set = 0;
    int number = 0;                 // index of the scene among those of its fractal and set
    std::uint64_t off = 0;          // pixels that differ visibly from the canonical picture
    std::uint64_t hit_or_miss = 0;  // pixels that hit instead of miss, or miss instead of hit
    // If a float picture differs visibly in more than most_off of its pixels: the percentage of pixels in which exact
    // mode's float picture of the scene differs visibly from exact mode's double picture. Else 0.
    double exact_off_percent = 0;
    Scene scene{};  // not stored
};

// Sum over the scenes of one set, or of all sets, of one fractal in one precision.
struct RandomSum {
    std::uint64_t pixels = 0, visibly_differing = 0, hit_or_miss = 0;  // pixels: all
    int scenes = 0;
    int far_off = 0;          // scenes in which more than most_off of the pixels differ visibly
    int short_of_digits = 0;  // far_off scenes whose exact_off_percent is also too high: the precision is too low
    double worst = 0;         // largest fraction of visibly differing pixels in one scene
    double worst_load = 0;    // largest multiple of a limit in one scene, and this scene
    Scene worst_scene{};

    void add(const RandomRow& row, std::uint64_t pixels_of_row);
    double off() const;         // fraction of the pixels that differ visibly
    double wrong_hits() const;  // fraction of the pixels that hit instead of miss, or miss instead of hit
    bool passed() const;        // true if both fractions are within their limits
};

// Sums for one fractal in one precision: over all scenes, and over the scenes of each set, by the set's seed.
struct RandomSums {
    std::string fractal;
    Precision precision = Precision::f64;
    RandomSum all;
    std::map<std::string, RandomSum> sets;
    // A line for each set that exceeds a limit, with the command of its worst scene, and a line for the largest step
    // factor with which no set does.
    std::string missed{};
};

// Limits for fast mode in each set.
inline constexpr double most_off = 0.02;           // fraction of the pixels that differ visibly
inline constexpr double most_wrong_hits = 0.0002;  // fraction of the pixels that hit or miss wrongly

struct RandomResult {
    std::string backend, without;
    int width = 0, height = 0;           // pixels of each picture
    nlohmann::ordered_json environment;  // set by the caller
    std::vector<RandomRow> rows;         // ordered by precision, fractal, set

    std::vector<RandomSums> sums;  // set by summed()
    bool passed() const;           // true if every set meets both limits
};

// Sets the sums, in the order of the fractals.
RandomResult summed(RandomResult result);

// Renders each scene of every set at 61 x 45 pixels: the expected picture of fast mode (core/render/expected.h), which
// is the canonical one, and the backend's picture in fast mode in both precisions. Calls `progress` with the completed
// fraction of the canonical pictures. Throws InputError if options.backend is unknown, and Unavailable if it has no
// device.
RandomResult measure_random(const Registry& registry, const RandomOptions& options,
                            const std::function<void(double)>& progress);

// Returns what a file holds.
nlohmann::ordered_json facts_of(const RandomResult& result);

// Returns a table with a line for each fractal and precision, and then RandomSums::missed.
std::string to_console(const RandomResult& result);

}  // namespace mandelmarch::bench
