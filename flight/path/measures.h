// SPDX-License-Identifier: Apache-2.0
// Measures of flights through a fractal: those by which a tour is planned, and the limits that the audit checks.
#pragma once

#include "core/scene/fractal.h"

namespace mandelmarch {

// Lengths of the plan are fractions of the size of the fractal's bounds; a clearance is the estimated distance from the
// surface.
struct FlightMeasures {
    double roads = 0.012;        // min clearance of the balls of free space through which a tour is planned
    double gate_least = 0.0040;  // min clearance of a gate, a narrow passage
    double gate_most = 0.02;     // max clearance of a gate
    double pace = 0.19;          // speed, in clearances per frame
    struct Limits {
        double step = 0.2;     // max step of the camera, in clearances per frame
        double aside = 10;     // max percentage of frames that look more than 60 degrees away from the motion
        double passages = 12;  // min number of passages per 7200 frames
        double planning = 20;  // max seconds of planning
    };
    Limits limits{};
};

// Returns the measures that were found for this fractal, or the defaults.
const FlightMeasures& flight_measures(const Fractal& fractal);

}  // namespace mandelmarch
