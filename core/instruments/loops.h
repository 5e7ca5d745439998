// SPDX-License-Identifier: Apache-2.0
// Counts the loop iterations of the kernel, for devices that limit the iterations of an invocation.
#pragma once

#include <string_view>

#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"

namespace mandelmarch {

// Returns the counts for a scene. Runs the kernel with all lanes active (core/kernel/prelude/loops.h), in exact mode,
// with normals from central differences. Throws Unavailable if this build does not contain the fractal.
Loops loops_of(const Scene& scene);

using CountLoops = Loops(const layout_f64::Scene& scene);
// Returns the function that loops.cpp.in defines for the fractal (cmake/Kernels.cmake); nullptr if there is none.
CountLoops* loop_counter(std::string_view fractal);

}  // namespace mandelmarch
