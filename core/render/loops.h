// SPDX-License-Identifier: Apache-2.0
// Counts the loop iterations of the kernel, for devices that limit the iterations of an invocation.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/render/kernel_scene.h"

namespace mandelmarch {

// Max number of iterations of all loops of an invocation, including nested ones. The end of a loop counts as one more
// iteration. Loops in branches that are not taken are not counted, although a device that masks lanes may execute them
// once.
struct Loops {
    std::int64_t pass;    // of a pass that marches or refines, without its steps or refinements
    std::int64_t step;    // of one marching step
    std::int64_t tried;   // of one refinement of a hit
    std::int64_t refine;  // of all refinements of a hit
    std::int64_t shade;   // of shading
};

// Returns the counts for a scene. Runs the kernel with all lanes active (core/kernel/prelude/loops.h), in exact mode,
// with normals from central differences.
Loops loops_of(const Scene& scene);

using CountLoops = Loops(const layout_f64::Scene& scene);
// Returns the function that loops.cpp.in defines for the fractal (cmake/Kernels.cmake); nullptr if there is none.
CountLoops* loop_counter(std::string_view fractal);

}  // namespace mandelmarch
