// SPDX-License-Identifier: Apache-2.0
// The OpenCL backend: the kernel on any OpenCL 1.2 device, in vectors if the device has vector units.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_opencl_backend();

}  // namespace mandelmarch
