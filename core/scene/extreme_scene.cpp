// SPDX-License-Identifier: Apache-2.0
#include "core/scene/extreme_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/base/error.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch {
namespace {

class Chance {
public:
    Chance(unsigned seed, int number)
    {
        std::seed_seq both{seed, static_cast<unsigned>(number)};
        random_.seed(both);
    }

    double between(double low, double high)
    {
        return low + (high - low) * static_cast<double>(random_()) / 4294967295.0;
    }

    // low, high > 0; every order of magnitude as likely.
    double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }

    // The single precision of parameter files.
    double single(double value) { return double{static_cast<float>(value)}; }

    bool one_in(int count) { return random_() % static_cast<unsigned>(count) == 0; }

    double sign() { return one_in(2) ? -1 : 1; }

    Vector direction()
    {
        for (;;) {
            const double x = between(-1, 1);
            const double y = between(-1, 1);
            const Vector v{x, y, between(-1, 1)};
            if (length(v) > 0.1 && length(v) < 1) return unit(v);
        }
    }

private:
    std::mt19937 random_;
};

struct Size {
    int width, height;
};

// `about`: the fractal's extent.
void draw_camera(Chance& chance, double about, Scene& scene)
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

void draw_shape(Chance& chance, Scene& scene)
{
    const std::string_view fractal = scene.fractal->nickname;
    if (fractal == "bulb") {
        scene.shape[1] = chance.one_in(4) ? chance.magnitude(1e-3, 1e6) : chance.between(1.2, 6);
        const double power = chance.one_in(5) ? chance.magnitude(0.01, 1000) : chance.between(1, 12);
        scene.shape[2] = chance.one_in(3) ? 8 : chance.one_in(2) ? std::max(1.0, std::floor(power)) : power;
    } else if (fractal == "box") {
        const double scale = chance.one_in(4) ? chance.magnitude(1e-2, 20) : chance.between(1.1, 3);
        scene.shape[0] = chance.sign() * scale;
        scene.shape[1] = chance.one_in(4) ? chance.magnitude(1e-4, 1e3) : chance.between(0.1, 1);
        scene.shape[2] = chance.one_in(4) ? chance.magnitude(1e-3, 1e3) : chance.between(0.7, 1.5);
        scene.escape = chance.one_in(3) ? chance.magnitude(1, 1e15) : 100;
    } else {
        const double most = chance.one_in(4) ? 4 : 0.7;
        for (double& value : scene.shape) value = chance.one_in(8) ? 0 : chance.between(-most, most);
        scene.escape = chance.between(-most, most);
    }
    for (double& value : scene.shape) value = chance.single(value);
    scene.escape = chance.single(scene.escape);
}

Scene drawn(Chance& chance, const Fractal& fractal, int number)
{
    constexpr std::array sizes{Size{48, 32}, Size{32, 24}, Size{33, 31}, Size{17, 40}, Size{61, 1}, Size{1, 29}};
    // An iteration of a pixel is about the same work in every scene.
    constexpr double pixel_iterations = 64.0 * 48 * 32;
    Scene scene;
    scene.fractal = &fractal;
    const double about = fractal.nickname == "box" ? 4 : 1.2;
    scene.shape = fractal.nickname == "bulb"  ? std::array{0.0, 4.0, 8.0}
                  : fractal.nickname == "box" ? std::array{2.0, 0.5, 1.0}
                                              : std::array{-0.25, 0.375, 0.125};
    scene.escape = fractal.nickname == "box" ? 100 : 0;
    scene.colouring = static_cast<int>(chance.between(0, colouring_types - 0.001));
    scene.brightness = chance.single(chance.one_in(6) ? chance.magnitude(1e-6, 1e6) : chance.between(0.5, 1.5));
    // Two by two of one size: what is left of the picture before shows.
    const Size size = sizes[static_cast<std::size_t>(number) / 2 % sizes.size()];
    scene.width = size.width;
    scene.height = size.height;
    scene.image_file = "scene.bmp";
    if (number % 4 == 3) {
        scene.eye = chance.between(1.1, 4) * about * chance.direction();
        scene.field_of_view = chance.between(0.5, 1.5);
        scene.detail = chance.single(chance.between(-9, -5));
        scene.iterations = static_cast<int>(chance.magnitude(1, 64));
        return scene;
    }
    draw_camera(chance, about, scene);
    draw_shape(chance, scene);
    scene.detail = chance.single(chance.one_in(8) ? chance.between(-37, 3) : chance.between(-9, -1));
    scene.iterations = static_cast<int>(chance.one_in(2) ? chance.between(1, 60) : chance.magnitude(1, max_iterations));
    const double pixels = pixel_iterations / scene.iterations;
    const double smaller = std::sqrt(std::min(1.0, pixels / (scene.width * scene.height)));
    scene.width = std::max(1, static_cast<int>(smaller * scene.width));
    scene.height = std::max(1, static_cast<int>(smaller * scene.height));
    return scene;
}

}  // namespace

Scene extreme_scene(const Fractal& fractal, unsigned seed, int number)
{
    Chance chance(seed, number);
    for (;;) {
        try {
            return parse_parameters(to_parameters(drawn(chance, fractal, number)), "a scene", fractal).scene;
        } catch (const InputError&) {
            // Values that do not go together: drawn again.
        }
    }
}

}  // namespace mandelmarch
