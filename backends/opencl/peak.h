// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of an OpenCL device.
#pragma once

#include "backends/opencl/device.h"

namespace mandelmarch::opencl {

// Returns operations per second. Throws Unavailable if the device does not support the precision, Error if the
// device fails.
double multiply_add_peak(const cl::Device& device, const RendererOptions& options);

}  // namespace mandelmarch::opencl
