// SPDX-License-Identifier: Apache-2.0
// Renders pictures on one OpenCL device.
#pragma once

#include <memory>

#include "backends/opencl/device.h"

namespace mandelmarch::opencl {

std::unique_ptr<Renderer> make_renderer(const cl::Device& device, const RendererOptions& options);

}  // namespace mandelmarch::opencl
