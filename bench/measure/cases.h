// SPDX-License-Identifier: Apache-2.0
// The configurations to measure.
#pragma once

#include <string>
#include <vector>

#include "bench/measure/options.h"
#include "bench/measure/studies.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

// Returns all configurations of the study that the options select. A backend without a device has a single
// configuration, which holds the reason. Throws InputError if a pattern of the filter is empty.
std::vector<Case> cases_of(const Registry& registry, const Options& options);

// Returns the name of the device's platform: the GPU's name, or Cpu::platform() for any device that runs on the CPU.
std::string platform_of(const Device& device);

}  // namespace mandelmarch::bench
