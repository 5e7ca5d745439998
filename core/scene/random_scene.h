// SPDX-License-Identifier: Apache-2.0
// Random scenes for studies and tests: usual ones, and those at the limits of what a parameter file allows.
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

// Returns scene `number` of the set `seed`. Its picture has at most 48 x 32 pixels, and fewer if it has many
// iterations. The scenes have detail levels from -37 to 3, 1 to max_iterations iterations, powers and scales of every
// kind, cameras far away, close, on an axis and in the solid, all colouring types, and odd sizes. Every fourth scene is
// less extreme: its rays take many steps of few iterations. Each scene has its own random sequence, fulfils
// check_scene() and the ranges of its parameter file, and is equal to the scene that the parser reads from its
// to_parameters().
Scene extreme_scene(const Fractal& fractal, unsigned seed, int number);

}  // namespace mandelmarch
