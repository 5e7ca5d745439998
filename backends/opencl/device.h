// SPDX-License-Identifier: Apache-2.0
// The devices of all OpenCL platforms, and how the kernel is compiled for each. Includes the OpenCL C++ bindings,
// version 1.2, with errors as exceptions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop

#include "core/render/backend.h"
#include "core/text/error.h"

namespace mandelmarch::opencl {

// Formats an OpenCL error as one line: the failed action and the error.
Error explained(const char* doing, const cl::Error& error);

// Runs `call` and converts OpenCL's errors with explained().
template <class Call>
auto checked(const char* doing, Call call)
{
    try {
        return call();
    } catch (const cl::Error& error) {
        throw explained(doing, error);
    }
}

// Returns the devices of all platforms; empty if no platform is installed.
std::vector<cl::Device> all_devices();

Device description(const cl::Device& device);

// Settings with which the kernel source is compiled for a device.
struct Build {
    int lanes = 1;           // pixels computed at once: the vector length of the kernel's `real`
    bool in_double = false;  // compute divisions and square roots of floats in double, rounded once
    std::string options;     // options of the OpenCL compiler
};

// Returns the settings for this device. options.simd_width is the number of lanes; 0: the number that suits the device.
// Throws Unavailable if the device does not support the options, InputError if OpenCL has no
// vectors with this number of lanes.
Build build_for(const cl::Device& device, const RendererOptions& options);

}  // namespace mandelmarch::opencl
