// SPDX-License-Identifier: Apache-2.0
// The OpenCL C++ bindings as this backend uses them: version 1.2, errors as exceptions.
#pragma once

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop

#include "core/base/error.h"

namespace mandelmarch::opencl {

// An OpenCL error as one line: what was tried, and what the device answered.
Error explained(const char* doing, const cl::Error& error);

// Runs `call`, turning OpenCL's errors into explained ones.
template <class Call>
auto checked(const char* doing, Call call)
{
    try {
        return call();
    } catch (const cl::Error& error) {
        throw explained(doing, error);
    }
}

}  // namespace mandelmarch::opencl
