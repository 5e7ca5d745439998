// SPDX-License-Identifier: Apache-2.0
// The Vulkan backend: the kernel as SPIR-V compute shaders, on GPUs, and on CPUs through lavapipe.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_vulkan_backend();

}  // namespace mandelmarch
