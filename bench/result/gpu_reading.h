// SPDX-License-Identifier: Apache-2.0
// Readings of a GPU's sensors, as stored in a result's environment.
#pragma once

#include <optional>
#include <string>

#include "bench/result/fields.h"
#include "bench/result/rules.h"

namespace mandelmarch::bench {

struct GpuReading {
    std::string name;
    std::optional<double> joules;               // during the measurement
    std::optional<double> watts, celsius;       // at its end
    std::optional<double> sm, most_sm, memory;  // MHz: multiprocessors' clock, its maximum, the memory's clock
    std::optional<std::string> throttled;       // reason for a reduced clock frequency, "idle" or "none"
};

namespace rules {

inline constexpr Rule megahertz{.min = 1, .max = 20e3};

}  // namespace rules

template <>
inline constexpr auto fields_of<GpuReading> =
    Description{"gpu",
                field("name", &GpuReading::name),
                field("joules", &GpuReading::joules),
                field("watts", &GpuReading::watts, "", {.min = 0, .max = 20e3}),
                field("celsius", &GpuReading::celsius, "", {.min = -100, .max = 200}),
                field("sm_megahertz", &GpuReading::sm, "", rules::megahertz),
                field("most_sm_megahertz", &GpuReading::most_sm, "", rules::megahertz),
                field("memory_megahertz", &GpuReading::memory, "", rules::megahertz),
                field("throttled", &GpuReading::throttled)};

}  // namespace mandelmarch::bench
