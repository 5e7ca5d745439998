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
    double step = 0.2;           // limit: max step of the camera, in clearances per frame
    double aside = 10;           // limit: max percentage of frames that look more than 60 degrees away from the motion
    double passages = 12;        // limit: min number of passages per 7200 frames
};

// Returns the fractal's own measures, or the defaults if it has none.
inline FlightMeasures flight_measures(const Fractal& fractal)
{
    if (fractal.name != "mandelbox") return {};
    // The estimate of the Mandelbox is about 3.5 times too small. Free space therefore seems to be narrower than it is,
    // which allows flights that are faster relative to the estimated clearance.
    return {.roads = 0.005,
            .gate_least = 0.0036,
            .gate_most = 0.006,
            .pace = 0.24,
            .step = 0.25,
            .aside = 2,
            .passages = 8};
}

}  // namespace mandelmarch
