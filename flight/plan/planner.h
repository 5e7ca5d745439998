// SPDX-License-Identifier: Apache-2.0
// The planner: makes a path from a seed.
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
    double seconds = 0;              // planning time
    int attempts = 0;                // tours tried
    std::vector<Ball> balls, gates;  // of the roadmaps; a gate as the ball around its narrowest point
};

// Receives progress messages, some with several lines.
using Log = std::function<void(const std::string&)>;

// Returns a flight of `frames` frames that keeps every promise of docs/flight.md. The scene's fractal changes by the
// schedule. The same seed gives the same path on any number of threads (0: all that the process may use).
// Throws InputError if the shape cannot be flown through (flight/field/hull.h), has no free space or no gates, or takes
// more processor time than `most_seconds` (0: a limit that grows with the frames); Error if no tour is long enough or
// keeps the promises.
Plan plan(const Scene& scene, const Schedule& schedule, std::uint64_t seed, int frames, int threads,
          const Log& log = {}, double most_seconds = 0);

}  // namespace mandelmarch
