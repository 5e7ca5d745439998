// SPDX-License-Identifier: Apache-2.0
// `bench random`: compares fast mode's pictures of random scenes with the reference's canonical ones.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/study/options.h"
#include "core/image/compare.h"
#include "core/render/registry.h"
#include "core/scene/scene.h"

namespace mandelmarch::bench {

struct RandomOptions {
    std::string backend = {};  // empty: the host's
    std::vector<const Fractal*> fractals = default_fractals();
    int scenes = 60;                                                 // per fractal and set
    std::vector<unsigned> sets{1001, 2002, 3003, 4004, 5005, 6006};  // seeds
    std::string without{};                                           // disabled optimisations, separated by commas
};

// Result of one scene in one precision.
struct RandomRow {
    unsigned set = 0;
    int number = 0;  // index of the scene in its set
    Scene scene;
    Precision precision = Precision::f64;
    Comparison off;  // difference from the canonical picture
    // Only of a picture in float with more than most_off visibly differing pixels: the fraction of pixels in which its
    // exact picture in float differs visibly from that in double. Else 0.
    double exact_off = 0;
};

// Sum over the scenes of one set, or of all sets, of one fractal in one precision. Fractions are of pixels.
struct RandomSum {
    std::uint64_t pixels = 0, visibly_differing = 0, hit_or_miss = 0;
    int scenes = 0;
    int far_off = 0;          // scenes in which more than most_off of the pixels differ visibly
    int short_of_digits = 0;  // scenes among these whose exact_off is above most_off, too: the precision is too low
    double worst = 0;         // largest fraction of visibly differing pixels in one scene

    void add(const RandomRow& row);
    double off() const;
    double wrong_hits() const;
    bool passed() const;  // true if both fractions are within their limits
};

// Sums of one fractal in one precision: over all scenes, and over each set by its seed.
struct RandomSums {
    std::string fractal;
    Precision precision = Precision::f64;
    RandomSum all;
    std::map<std::string, RandomSum> sets;
};

// Limits for fast mode in each set: fractions of pixels that differ visibly, and that hit or miss wrongly.
inline constexpr double most_off = 0.02;
inline constexpr double most_wrong_hits = 0.0002;

struct RandomResult {
    RandomOptions options;
    int width = 0, height = 0;  // pixels of each picture
    nlohmann::ordered_json environment;
    std::vector<RandomSums> sums;
    std::vector<RandomRow> rows;  // by fractal, precision, set

    bool passed() const;  // true if every set meets both limits
};

// Renders the scenes of every set at 61 x 45 pixels: the canonical picture, and the backend's picture in fast mode.
// Canonical pictures are rendered by reference or, if reference does not support the fractal, by openmp's scalar kernel
// without the optimisations of the march. Calls `progress` with the completed fraction. Throws InputError for an
// unknown backend, Unavailable if it has no device.
RandomResult measure_random(const Registry& registry, const RandomOptions& options,
                            const std::function<void(double)>& progress);

nlohmann::ordered_json json_of(const RandomResult& result);

// Returns a table with a line for each fractal and precision.
std::string to_console(const RandomResult& result);

}  // namespace mandelmarch::bench
