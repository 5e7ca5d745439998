// SPDX-License-Identifier: Apache-2.0
// Scenes at the edges of what a parameter file may say, for comparing backends.
#pragma once

#include "core/scene/scene.h"

namespace mandelmarch {

// The scene with this number of the set `seed`, at most 48 x 32 pixels: details to 10^-9, 1 to max_iterations
// iterations (the more, the smaller the picture), powers and scales of every kind, cameras far, near, on an axis and in
// the solid, all colouring types, odd sizes. Every fourth is plain but for rays of many steps and few iterations. Each
// number has a stream of its own. The scene has passed check_scene and the ranges of its parameter file, and is what
// reading that file gives (to_parameters).
Scene extreme_scene(const Fractal& fractal, unsigned seed, int number);

}  // namespace mandelmarch
