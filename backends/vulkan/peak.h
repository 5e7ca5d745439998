// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of a Vulkan device.
#pragma once

#include "core/render/backend.h"

namespace mandelmarch::vulkan {

// Operations per second. Throws Unavailable where the device is not there or lacks the precision, Error if it fails.
double multiply_add_peak(const RendererOptions& options);

}  // namespace mandelmarch::vulkan
