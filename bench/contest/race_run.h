// SPDX-License-Identifier: Apache-2.0
// Runs `bench race`; bench/contest/race.h prints the result.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/study/options.h"
#include "bench/contest/race.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

struct RaceOptions {
    std::vector<std::string> programs;        // paths
    const Fractal* fractal = nullptr;         // nullptr: the first
    std::string scene;                        // a parameter file; empty: the fractal's official scene
    std::optional<std::pair<int, int>> size;  // pixels; nullopt: that of the parameter file, or 540 x 540
    std::string backend = "openmp";           // the backend that our renderer uses
    std::uint64_t seed = 1;                   // for the order in each round
    double limit = 60;                        // seconds per picture
    int rounds = 7;
};

// Runs each program as `PROGRAM scene.dat` in a folder that contains only this parameter file. The file names the
// picture image.bmp, which is then compared with our scalar kernel's picture in double and exact mode. Programs with a
// correct picture are timed as whole processes, in rounds of random order, together with our `render` on the backend
// that the options select (all: openmp). Each round has its own view of the scene, so that a picture kept from an
// earlier run is wrong; the pictures of the rounds must be correct, too. A program whose first run took more than
// longest_repeated is not run again: that run is its sample. `progress` receives the completed fraction, 0 to 1. Throws
// InputError if a program is not an executable file or the scene cannot be read, Error if our own picture cannot be
// rendered.
inline constexpr double longest_repeated = 20;  // seconds
Race run_race(const RaceOptions& options, const Registry& registry, const std::function<void(double)>& progress);

}  // namespace mandelmarch::bench
