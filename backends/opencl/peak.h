// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of an OpenCL device.
#pragma once

#include "backends/opencl/device.h"

namespace mandelmarch::opencl {

// Operations per second. Throws Unavailable where the device lacks the precision, Error if it fails.
double multiply_add_peak(const cl::Device& device, const RendererOptions& options);

}  // namespace mandelmarch::opencl
