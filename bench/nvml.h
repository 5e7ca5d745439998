// SPDX-License-Identifier: Apache-2.0
// Queries NVIDIA's management library (NVML), if installed.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mandelmarch::bench {

struct GpuState {
    std::string name;
    std::optional<double> joules;               // since the driver was loaded
    std::optional<double> watts, celsius;       // now
    std::optional<double> sm, most_sm, memory;  // clock frequencies, MHz
    std::optional<std::string> throttled;       // reason for a reduced clock frequency; "none" if not reduced
};

struct GpuStates {
    std::vector<GpuState> gpus;
    std::string missing;  // why there are none; else empty
};

// `library`: file name for the dynamic linker.
GpuStates gpu_states(const std::string& library);

}  // namespace mandelmarch::bench
