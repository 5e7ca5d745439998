// SPDX-License-Identifier: Apache-2.0
// NVIDIA's management library, where it is installed.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mandelmarch::bench {

struct GpuState {
    std::string name;
    std::optional<double> joules;               // since the driver was loaded
    std::optional<double> watts, celsius;       // now
    std::optional<double> sm, most_sm, memory;  // clocks, MHz
    std::optional<std::string> throttled;       // why the clock is lower than it could be, "none" if it is not
};

struct GpuStates {
    std::vector<GpuState> gpus;
    std::string missing;  // why there are none; empty if there are
};

// `library`: the file's name, as the linker finds it.
GpuStates gpu_states(const std::string& library);

}  // namespace mandelmarch::bench
