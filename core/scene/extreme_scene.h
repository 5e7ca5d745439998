// SPDX-License-Identifier: Apache-2.0
// Scenes at the limits of what a parameter file allows, for comparing backends.
#pragma once

#include "core/scene/scene.h"

namespace mandelmarch {

// Returns scene `number` of the set `seed`, at most 48 x 32 pixels: details down to 10^-9, 1 to max_iterations
// iterations (the more, the smaller the picture), powers and scales of every kind, cameras far, near, on an axis and in
// the solid, all colouring types, odd sizes. Every fourth scene has rays of many steps and few iterations instead. Each
// number has an independent random stream. The scene passes check_scene and the ranges of its parameter file, and
// equals the one read back from to_parameters().
Scene extreme_scene(const Fractal& fractal, unsigned seed, int number);

}  // namespace mandelmarch
