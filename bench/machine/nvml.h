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
    std::optional<double> sm, most_sm, memory;  // clock frequencies, MHz: multiprocessors, their maximum, memory
    std::optional<std::string> throttled;       // reason for a reduced clock frequency; "none" if not reduced
};

struct GpuStates {
    std::vector<GpuState> gpus;
    std::string missing;  // why there are no GPUs; empty if there are some
};

// Returns the state of every NVIDIA GPU. `library`: file name of NVML, as passed to dlopen().
GpuStates gpu_states(const std::string& library);

}  // namespace mandelmarch::bench
