// SPDX-License-Identifier: Apache-2.0
// The body that holds a fractal, and its size.
#pragma once

#include <string>

#include "core/scene/fractal.h"
#include "core/scene/scene.h"

namespace mandelmarch {

class Field;

// The reason why the scene's fractal cannot be flown through, in one line with the expected input; empty if it can be.
// Depends on the scene's shape alone and computes no distance.
std::string flight_objection(const Scene& scene);

// Throws InputError with flight_objection(), if any.
void check_flown(const Scene& scene);

// What the fractal's row says, or a sphere found by rays from far outside.
Hull hull_of(const Scene& scene, const Field& field);

}  // namespace mandelmarch
