// SPDX-License-Identifier: Apache-2.0
// `bench random`: how near fast mode's pictures of random scenes come to reference's canonical ones.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/image/compare.h"
#include "core/render/registry.h"
#include "core/scene/scene.h"

namespace mandelmarch::bench {

struct RandomOptions {
    std::string backend = {};                                        // empty: the host's
    std::string fractal = "all";                                     // all: those that are studied; or one's name
    int scenes = 60;                                                 // of a fractal in each set
    std::vector<unsigned> sets{1001, 2002, 3003, 4004, 5005, 6006};  // seeds
    std::string without{};                                           // techniques that are switched off
};

// One scene in one precision.
struct RandomRow {
    unsigned set = 0;
    int number = 0;  // of the scene in its set
    Scene scene;
    Precision precision = Precision::f64;
    Comparison off;        // from the canonical picture
    double exact_off = 0;  // the share of pixels in which exact mode is visibly off its own picture in double
};

// All scenes of one set, or of all sets, of one fractal in one precision. Shares are of pixels.
struct RandomSum {
    std::uint64_t pixels = 0, visibly_differing = 0, hit_or_miss = 0;
    int scenes = 0;
    int far_off = 0;          // scenes with more than most_off of their pixels visibly off
    int short_of_digits = 0;  // those of them in which exact mode is as far off its picture in double
    double worst = 0;         // the largest share of one scene

    void add(const RandomRow& row);
    double off() const;
    double wrong_hits() const;
};

// What fast mode is held to, each set for itself.
inline constexpr double most_off = 0.02;
inline constexpr double most_wrong_hits = 0.0002;

struct RandomResult {
    RandomOptions options;
    nlohmann::ordered_json environment;
    std::vector<RandomRow> rows;  // by fractal, precision, set

    RandomSum sum(std::string_view fractal, Precision precision, const unsigned* set) const;
    bool held() const;  // every set to both
};

// Draws the fractals of every set, 61 x 45 pixels, by canonical steps and by the backend in fast mode. Canonical steps
// are reference's, or openmp's without techniques where reference does not draw the fractal. progress(share) is called
// as it goes. Throws InputError for an unknown backend, Unavailable where it has no device.
RandomResult measure_random(const Registry& registry, const RandomOptions& options,
                            const std::function<void(double)>& progress);

nlohmann::ordered_json json_of(const RandomResult& result);

// A line for each fractal and precision.
std::string to_console(const RandomResult& result);

}  // namespace mandelmarch::bench
