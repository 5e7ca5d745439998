// SPDX-License-Identifier: Apache-2.0
// The OpenCL C++ bindings for this backend: version 1.2, errors as exceptions.
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

}  // namespace mandelmarch::opencl
