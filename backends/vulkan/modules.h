// SPDX-License-Identifier: Apache-2.0
// The SPIR-V modules that the build made. Names: FRACTAL_PRECISION_MODE and probe_PRECISION, the float ones of exact
// mode also with _corrected, by exact residuals, and _pinned, in double (core/kernel/prelude/glsl.h).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace mandelmarch::vulkan {

using Module = std::span<const std::uint32_t>;

// Empty if there is none of this name.
Module module_named(std::string_view name);

}  // namespace mandelmarch::vulkan
