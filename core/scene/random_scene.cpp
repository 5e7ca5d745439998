// SPDX-License-Identifier: Apache-2.0
#include "core/scene/random_scene.h"

#include <cmath>

#include "core/scene/scene_random.h"
#include "core/scene/fractal.h"

namespace mandelmarch {

Scene random_scene(const Scene& like, int number, std::mt19937& random)
{
    SceneRandom chance(random);
    const bool even = number % 2 == 0;
    const FractalRandom& row = like.fractal->random;
    Scene scene = like;
    const double distance = chance.between(row.nearest, row.farthest);
    const double height = chance.between(-0.9, 0.9);
    const double angle = chance.between(0, 6.28);
    scene.eye = {distance * std::cos(angle), distance * height, distance * std::sin(angle)};
    scene.target.x = chance.between(-0.3, 0.3);
    scene.target.y = chance.between(-0.3, 0.3);
    scene.target.z = chance.between(-0.3, 0.3);
    scene.field_of_view = chance.between(0.5, 2);
    scene.detail = chance.single_between(-4, -2);
    scene.colouring = even ? 0 : 1;
    scene.iterations = static_cast<int>(chance.between(4, 40));
    row.shape(scene, chance, even);
    return scene;
}

}  // namespace mandelmarch
