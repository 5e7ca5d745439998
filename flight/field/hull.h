// SPDX-License-Identifier: Apache-2.0
// The body that holds a fractal, its size, and the symmetries under which two places of it look the same.
#pragma once

#include "core/scene/scene.h"

namespace mandelmarch {

class Field;

struct Hull {
    enum class Shape { cube, sphere };
    Shape shape = Shape::sphere;
    double size = 1;  // half the cube's edge, or the sphere's radius

    bool contains(Vector p) const;
};

// Mandelbox of scale s: a cube of half edge 2 (s + 1)/(s - 1) for s > 1 and 2 for s < -1. Mandelbulb of power P > 1: a
// sphere of radius 2^(1/(P - 1)). Others: a sphere found by rays from far outside.
Hull hull_of(const Scene& scene, const Field& field);

// Places that the fractal's symmetry maps onto each other get the same answer: the one of them in the fundamental
// region. Mandelbox: the cube's 48. Mandelbulb: mirrored in y; whole P: (P - 1)-fold about z, odd P: also mirrored in
// z. Others: none.
Vector representative(const Scene& scene, Vector p);

// True in a region that holds a copy of every place that differs under the symmetry, and some more: where tours are
// sought, as the rest would only cost time.
bool worth_searching(const Scene& scene, const Hull& hull, Vector p);

}  // namespace mandelmarch
