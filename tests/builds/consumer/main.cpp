// SPDX-License-Identifier: Apache-2.0
// Renders a small Mandelbulb with the installed package and counts the pixels that hit.
#include <cmath>
#include <cstdio>

#include "backends/all.h"
#include "core/scene/fractal.h"

int main()
{
    using namespace mandelmarch;
    const Registry registry = all_backends();
    Scene scene;
    scene.fractal = &fractal_named("mandelbulb");
    scene.eye = {1.2, 0.26, 0.2};
    scene.width = scene.height = 32;
    scene.shape = {0, 4, 8};
    scene.iterations = 50;
    Image image(scene.width, scene.height, Image::Layers::all);
    registry.find("openmp")->create({})->render(scene, image);
    int hits = 0;
    for (const PixelValue& value : image.values()) hits += !std::isinf(value.depth);
    std::printf("%d of %zu pixels hit\n", hits, image.pixels());
    return hits > 100 ? 0 : 1;
}
