// SPDX-License-Identifier: Apache-2.0
// Scenes drawn at random, for studies and tests.
#pragma once

#include <random>

#include "core/scene/scene.h"

namespace mandelmarch {

// `like` with a camera, a shape, a detail and a limit of iterations drawn from `random`; the same numbers give the same
// scene on every machine. Even and odd `number` share the kinds: whole powers and any, scales above and below 0,
// colourings 0 and 1.
Scene random_scene(const Scene& like, int number, std::mt19937& random);

}  // namespace mandelmarch
