// SPDX-License-Identifier: Apache-2.0
// Scenes at the limits of what a parameter file allows, for comparing backends.
#pragma once

#include "core/scene/scene.h"

namespace mandelmarch {

// Returns scene `number` of the set `seed`. Its picture has at most 48 x 32 pixels, and fewer if it has many
// iterations. The scenes have detail levels from -37 to 3, 1 to max_iterations iterations, powers and scales of every
// kind, cameras far away, close, on an axis and in the solid, all colouring types, and odd sizes. Every fourth scene is
// less extreme: its rays take many steps of few iterations. Each scene has its own random sequence, fulfils
// check_scene() and the ranges of its parameter file, and is equal to the scene that the parser reads from its
// to_parameters().
Scene extreme_scene(const Fractal& fractal, unsigned seed, int number);

}  // namespace mandelmarch
