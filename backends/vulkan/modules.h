// SPDX-License-Identifier: Apache-2.0
// The generated SPIR-V modules. They are named FRACTAL_PRECISION_MODE, probe_PRECISION_exact and peak_PRECISION_fast.
// Each float module of exact mode also exists with the suffix _corrected, which corrects divisions by their exact
// residuals, and _pinned, which divides in double (core/kernel/prelude/glsl.h).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace mandelmarch::vulkan {

using Module = std::span<const std::uint32_t>;

// Returns a module; empty if no module has this name.
Module module_named(std::string_view name);

}  // namespace mandelmarch::vulkan
