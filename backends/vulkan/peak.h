// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of a Vulkan device.
#pragma once

#include "core/render/backend.h"

namespace mandelmarch::vulkan {

// Returns operations per second. Throws Unavailable if the device does not exist or does not support the precision,
// Error if the device fails.
double multiply_add_peak(const RendererOptions& options);

}  // namespace mandelmarch::vulkan
