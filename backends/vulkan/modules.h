// SPDX-License-Identifier: Apache-2.0
// The generated SPIR-V modules. Names: FRACTAL_PRECISION_MODE and probe_PRECISION. Float modules of exact mode also
// exist with _corrected (exact residuals) and _pinned (in double); see core/kernel/prelude/glsl.h.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace mandelmarch::vulkan {

using Module = std::span<const std::uint32_t>;

// Empty if no module has this name.
Module module_named(std::string_view name);

}  // namespace mandelmarch::vulkan
