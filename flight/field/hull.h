// SPDX-License-Identifier: Apache-2.0
// The body that holds a fractal, and its size.
#pragma once

#include "core/scene/fractal.h"
#include "core/scene/scene.h"

namespace mandelmarch {

class Field;

// What the fractal's row says, or a sphere found by rays from far outside.
Hull hull_of(const Scene& scene, const Field& field);

}  // namespace mandelmarch
