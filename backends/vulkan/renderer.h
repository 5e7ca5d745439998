// SPDX-License-Identifier: Apache-2.0
// Renders scenes on one Vulkan device.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch::vulkan {

// Returns a renderer. Throws Unavailable if the device does not exist or does not support the options.
std::unique_ptr<Renderer> make_renderer(const RendererOptions& options);

}  // namespace mandelmarch::vulkan
