// SPDX-License-Identifier: Apache-2.0
#include "flight/path/measures.h"

namespace mandelmarch {

const FlightMeasures& flight_measures(const Fractal& fractal)
{
    // The estimate of the Mandelbox is about 3.5 times too small. Free space therefore seems to be narrower than it is,
    // which allows flights that are faster relative to the estimated clearance.
    static constexpr FlightMeasures box{
        .roads = 0.005,
        .gate_least = 0.0036,
        .gate_most = 0.006,
        .pace = 0.24,
        .limits = {.step = 0.25, .aside = 2, .passages = 8, .planning = 15},
    };
    static constexpr FlightMeasures usual{};
    return fractal.name == "mandelbox" ? box : usual;
}

}  // namespace mandelmarch
