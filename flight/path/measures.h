// SPDX-License-Identifier: Apache-2.0
// Measures of flights through a fractal: values with which a tour is planned, and limits that the audit checks.
#pragma once

#include "core/scene/fractal.h"

namespace mandelmarch {

// The clearances `roads`, `gate_least` and `gate_most` are in fractal sizes. A fractal size is the size of the
// fractal's bounds; a clearance is the estimated distance from the surface.
struct FlightMeasures {
    double roads = 0.012;        // min clearance of the balls of free space through which a tour is planned
    double gate_least = 0.0040;  // min clearance of a gate, a narrow passage
    double gate_most = 0.02;     // max clearance of a gate
    double pace = 0.19;          // speed, in clearances per frame
    struct Limits {
        double step = 0.2;     // max step of the camera, in clearances per frame
        double aside = 10;     // max percentage of frames that look more than 60 degrees away from the motion
        double passages = 12;  // min number of passages per 7200 frames
        double planning = 10;  // max seconds of planning
    };
    Limits limits{};
};

// Returns the fractal's own measures, or the defaults if it has none.
const FlightMeasures& flight_measures(const Fractal& fractal);

}  // namespace mandelmarch
