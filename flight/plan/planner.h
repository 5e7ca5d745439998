// SPDX-License-Identifier: Apache-2.0
// From a seed to a path.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/scene/scene.h"
#include "flight/path/path.h"
#include "flight/plan/balls.h"
#include "flight/plan/schedule.h"

namespace mandelmarch {

struct Plan {
    Path path;
    double seconds = 0;              // that planning took
    int attempts = 0;                // tours flown and audited
    std::vector<Ball> balls, gates;  // what the tours were sought in; a gate as its narrowest place
};

// Called with what is being done.
using Log = std::function<void(const std::string&)>;

// A flight of `frames` frames through the scene's fractal, which changes by the schedule, that keeps every promise of
// docs/flight.md. The same seed gives the same path, on any number of threads (0: one a core). Throws Error where the
// fractal has no free space to fly in or no tour keeps the promises.
Plan plan(const Scene& scene, const Schedule& schedule, std::uint64_t seed, int frames, int threads,
          const Log& log = {});

}  // namespace mandelmarch
