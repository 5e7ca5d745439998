// SPDX-License-Identifier: Apache-2.0
// Measures what bench/race.h shows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/options.h"
#include "bench/race.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

struct RacePlan {
    std::vector<std::string> programs;  // files
    std::string scene;                  // a parameter file; empty: the fractal's official scene
    double limit = 60;                  // seconds that a program may take for a picture
    int rounds = 7;
};

// Runs each program as `PROGRAM scene.dat` in an empty folder that holds the parameter file, which names image.bmp, and
// compares that picture with our scalar text's, in double and exact mode. Programs whose picture is right are then
// timed as whole processes, in rounds of an order drawn by lot, beside our own `render` on the backend that the options
// choose (all: openmp). Every timed picture must be the proven one. A program that took more than longest_repeated is
// not run again: its proof is its sample. `progress` is told the finished share, 0 to 1. Throws InputError where a
// program is no file that can be run or the scene cannot be read, Error where our own picture cannot be drawn.
inline constexpr double longest_repeated = 20;  // seconds
Race run_race(const RacePlan& plan, const Options& options, const Registry& registry,
              const std::function<void(double)>& progress);

}  // namespace mandelmarch::bench
