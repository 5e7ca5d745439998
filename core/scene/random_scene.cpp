// SPDX-License-Identifier: Apache-2.0
#include "core/scene/random_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/scene/scene_random.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

struct Size {
    int width, height;
};

// Draws a random camera. `about`: approximate max distance of the fractal from the origin.
void draw_camera(SceneRandom& chance, double about, Scene& scene)
{
    scene.target = chance.one_in(2) ? Vector{0, 0, 0} : chance.between(0, 0.7 * about) * chance.direction();
    switch (static_cast<int>(chance.between(0, 5.999))) {
        case 0: scene.eye = chance.magnitude(10 * about, 2000) * chance.direction(); break;
        case 1: scene.eye = scene.target + chance.magnitude(1e-7, 0.1) * chance.direction(); break;
        case 2:
            scene.eye = {0, 0, chance.sign() * chance.between(0.5, 3) * about};
            scene.target = {0, 0, 0};
            break;
        default: scene.eye = chance.between(0.3, 2.5) * about * chance.direction();
    }
    scene.up = chance.one_in(3) ? chance.magnitude(1e-3, 1e3) * chance.direction() : Vector{0, 1, 0};
    if (chance.one_in(6)) scene.up = {1, 0, 0};
    scene.field_of_view = chance.one_in(4) ? chance.magnitude(1e-6, 2.7) : chance.between(0.3, 2);
}

void draw_shape(SceneRandom& chance, Scene& scene)
{
    scene.fractal->random.extreme_shape(scene, chance);
    for (double& value : scene.shape) value = SceneRandom::single(value);
    scene.escape = SceneRandom::single(scene.escape);
}

// Sets the values of lines 7 and 8 of the parameter file, for scenes that do not vary these values.
void set_plain_shape(const Fractal& fractal, Scene& scene)
{
    if (const auto& plain = fractal.random.plain) {
        scene.shape = {(*plain)[0], (*plain)[1], (*plain)[2]};
        scene.escape = (*plain)[3];
        return;
    }
    const Scene official = official_scene(fractal);
    scene.shape = official.shape;
    scene.escape = official.escape;
}

Scene drawn(SceneRandom& chance, const Fractal& fractal, int number)
{
    constexpr std::array sizes{Size{48, 32}, Size{32, 24}, Size{33, 31}, Size{17, 40}, Size{61, 1}, Size{1, 29}};
    // Approximate max of the number of pixels times the number of iterations.
    constexpr double pixel_iterations = 64.0 * 48 * 32;
    Scene scene;
    scene.fractal = &fractal;
    const double about = fractal.random.extent;
    set_plain_shape(fractal, scene);
    scene.colouring = static_cast<int>(chance.between(0, colouring_types - 0.001));
    scene.brightness = SceneRandom::single(chance.one_in(6) ? chance.magnitude(1e-6, 1e6) : chance.between(0.5, 1.5));
    // Scenes 2n and 2n + 1 have the same size, unless one has many iterations. So a comparison detects a backend that
    // leaves parts of the previous picture in its buffers.
    const Size size = sizes[static_cast<std::size_t>(number) / 2 % sizes.size()];
    scene.width = size.width;
    scene.height = size.height;
    scene.image_file = "scene.bmp";
    if (number % 4 == 3) {
        scene.eye = chance.between(1.1, 4) * about * chance.direction();
        scene.field_of_view = chance.between(0.5, 1.5);
        scene.detail = SceneRandom::single(chance.between(-9, -5));
        scene.iterations = static_cast<int>(chance.magnitude(1, 64));
        return scene;
    }
    draw_camera(chance, about, scene);
    draw_shape(chance, scene);
    scene.detail = SceneRandom::single(chance.one_in(8) ? chance.between(-37, 3) : chance.between(-9, -1));
    scene.iterations = static_cast<int>(chance.one_in(2) ? chance.between(1, 60) : chance.magnitude(1, max_iterations));
    const double pixels = pixel_iterations / scene.iterations;
    const double smaller = std::sqrt(std::min(1.0, pixels / (scene.width * scene.height)));
    scene.width = std::max(1, static_cast<int>(smaller * scene.width));
    scene.height = std::max(1, static_cast<int>(smaller * scene.height));
    return scene;
}

}  // namespace

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

Scene extreme_scene(const Fractal& fractal, unsigned seed, int number)
{
    std::seed_seq both{seed, static_cast<unsigned>(number)};
    std::mt19937 random(both);
    SceneRandom chance(random);
    for (;;) {
        try {
            return parse_parameters(to_parameters(drawn(chance, fractal, number)), "a scene", fractal).scene;
        } catch (const InputError&) {
            // The values are incompatible with each other; the loop draws another scene.
        }
    }
}

}  // namespace mandelmarch
