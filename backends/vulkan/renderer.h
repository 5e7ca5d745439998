// SPDX-License-Identifier: Apache-2.0
// Draws scenes on one Vulkan device.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch::vulkan {

// Throws Unavailable if the device is not there or cannot do what is asked.
std::unique_ptr<Renderer> make_renderer(const RendererOptions& options);

}  // namespace mandelmarch::vulkan
