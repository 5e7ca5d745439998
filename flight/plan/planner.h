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
// docs/flight.md. The same seed gives the same path, on any number of threads (0: all that the process may use).
// Throws InputError if the shape cannot be flown through (flight/field/hull.h), has no free space or no gates, or takes
// more processor time than `most_seconds` (0: an amount that grows with the frames); Error if no tour is long enough or
// keeps the promises.
Plan plan(const Scene& scene, const Schedule& schedule, std::uint64_t seed, int frames, int threads,
          const Log& log = {}, double most_seconds = 0);

}  // namespace mandelmarch
