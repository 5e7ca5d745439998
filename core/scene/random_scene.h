// SPDX-License-Identifier: Apache-2.0
// Random scenes for studies and tests.
#pragma once

#include <random>
#include <string>

#include "core/scene/scene.h"

namespace mandelmarch {

// A scene and the name that messages give it.
struct NamedScene {
    std::string name;
    Scene scene;
};

// Returns `like` with a random camera, shape, detail and number of iterations. The same random numbers give the same
// scene on every machine. Scenes with even and odd `number` are of different kinds: for example, powers are integers or
// any powers, scales are above or below 0, and colourings are 0 or 1.
Scene random_scene(const Scene& like, int number, std::mt19937& random);

}  // namespace mandelmarch
