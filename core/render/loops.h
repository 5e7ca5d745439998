// SPDX-License-Identifier: Apache-2.0
// Limits of the kernel's loop iterations, for devices that limit the iterations of an invocation.
#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace mandelmarch {

// Max iterations of all loops of one invocation. The end of a loop counts as one more; each nested loop is counted.
// Branches not taken are not counted, although a device with masks may execute their loops once.
struct Loops {
    std::int64_t pass;    // of marching and refinement, without their steps
    std::int64_t step;    // per marching step
    std::int64_t tried;   // per refinement
    std::int64_t refine;  // of a whole refinement
    std::int64_t shade;
};

// Returns the limits for a scene, counted by running the kernel with all lanes active (core/kernel/prelude/loops.h) and
// with normals from differences.
Loops loops_of(const Scene& scene);

}  // namespace mandelmarch
