// SPDX-License-Identifier: Apache-2.0
// The planner makes the path of a flight from a seed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/scene/scene.h"
#include "flight/path/path.h"
#include "flight/path/places.h"
#include "flight/route/balls.h"
#include "flight/route/schedule.h"

namespace mandelmarch {

struct Plan {
    Path path;
    double seconds = 0;              // planning time
    int attempts = 0;                // tours tried
    std::vector<Ball> balls, gates;  // of all roadmaps; a gate is stored as the ball around its narrowest point
};

// A function that receives progress messages, some of which have several lines.
using Log = std::function<void(const std::string&)>;

struct PlanOptions {
    Scene scene;             // the fractal; the camera and the size are unused
    Schedule schedule = {};  // how the fractal changes in flight
    std::uint64_t seed = 1;
    int frames = 0;   // length of the flight; if it ends at the last of the places, its largest length
    int threads = 0;  // 0 for as many as the process may use
    Log log = {};
    double most_seconds = 0;  // limit on the processor time; 0: a limit that grows with the frames
    // Places that the flight visits. The flight ends at the last one, unless a tour follows it.
    Places places = {};
};

// Returns a flight that keeps every promise of docs/flight.md. The same seed gives the same path on any number of
// threads.
// Throws InputError if the shape cannot be flown through, if it has no free space or (unless it changes) no gates, or
// if the limit is exceeded. Throws Error if no tour is long enough, or none keeps the promises.
// Throws InputError with a place's file and line if the shape changes, if the place cannot be reached or seen, or if no
// flight is in time.
Plan plan(PlanOptions options);

}  // namespace mandelmarch
