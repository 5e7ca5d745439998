// SPDX-License-Identifier: Apache-2.0
// Random scenes for studies and tests.
#pragma once

#include <random>

#include "core/scene/scene.h"

namespace mandelmarch {

// Returns `like` with a random camera, shape, detail and limit of iterations; the same numbers give the same scene on
// every machine. Even and odd `number` alternate between kinds: integer and other powers, scales above and below 0,
// colourings 0 and 1.
Scene random_scene(const Scene& like, int number, std::mt19937& random);

}  // namespace mandelmarch
