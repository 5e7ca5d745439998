// SPDX-License-Identifier: Apache-2.0
// How often the kernel text loops at most, for devices that survive so many loops only.
#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace mandelmarch {

// Rounds of all loops of one invocation, each loop's end counted as one more; nested loops count each for themselves.
// Branches that are not taken are not counted, though a device with masks may run each of their loops once.
struct Loops {
    std::int64_t pass;    // of marching and refining, beside their steps
    std::int64_t step;    // of marching
    std::int64_t tried;   // a root that refining tries
    std::int64_t refine;  // all that a ray is refined
    std::int64_t shade;
};

// Counted by running the text with every lane on (core/kernel/prelude/loops.h), normals from differences included.
Loops loops_of(const Scene& scene);

}  // namespace mandelmarch
