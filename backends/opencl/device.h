// SPDX-License-Identifier: Apache-2.0
// OpenCL's devices, over all platforms, and what they can do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "backends/opencl/api.h"
#include "core/render/backend.h"

namespace mandelmarch::opencl {

// Empty where no platform is installed.
std::vector<cl::Device> all_devices();

Device description(const cl::Device& device);

// How the kernel text is compiled for a device.
struct Build {
    int lanes = 1;           // pixels at once: the length of the text's `real`
    bool in_double = false;  // quotients and roots of floats are computed in double and rounded once
    std::string options;     // for the compiler
};

// `pack` is the wish for lanes, 0 for the device's preference. Throws Unavailable where the device cannot do what is
// asked, InputError where OpenCL has no vector of that length.
Build build_for(const cl::Device& device, const RendererOptions& options);

}  // namespace mandelmarch::opencl
