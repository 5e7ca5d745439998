// SPDX-License-Identifier: Apache-2.0
// Runs `bench race`; bench/race.h prints the result.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/options.h"
#include "bench/race.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

struct RaceOptions {
    std::vector<std::string> programs;  // paths
    std::string scene;                  // a parameter file; empty: the fractal's official scene
    double limit = 60;                  // seconds per picture
    int rounds = 7;
};

// Runs each program as `PROGRAM scene.dat` in an empty folder with the parameter file, which names image.bmp, and
// compares that picture with our scalar kernel's, in double and exact mode. Programs with a correct picture are then
// timed as whole processes, in rounds of random order, together with our `render` on the backend that the options
// select (all: openmp). Every timed picture must equal the verified one. A program that took more than longest_repeated
// is not run again: the verified run is its sample. `progress` receives the completed fraction, 0 to 1. Throws
// InputError if a program is not an executable file or the scene cannot be read, Error if our own picture cannot be
// rendered.
inline constexpr double longest_repeated = 20;  // seconds
Race run_race(const RaceOptions& plan, const Options& options, const Registry& registry,
              const std::function<void(double)>& progress);

}  // namespace mandelmarch::bench
