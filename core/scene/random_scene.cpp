// SPDX-License-Identifier: Apache-2.0
#include "core/scene/random_scene.h"

#include <cmath>

#include "core/scene/fractal.h"

namespace mandelmarch {

Scene random_scene(const Scene& like, int number, std::mt19937& random)
{
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
    };
    // The single precision of parameter files.
    const auto single = [&](double low, double high) { return double{static_cast<float>(between(low, high))}; };
    const bool even = number % 2 == 0;
    const std::string_view fractal = like.fractal->nickname;
    Scene scene = like;
    const double distance = fractal == "box" ? between(3, 14) : between(1.1, 2.5);
    const double height = between(-0.9, 0.9);
    const double angle = between(0, 6.28);
    scene.eye = {distance * std::cos(angle), distance * height, distance * std::sin(angle)};
    scene.target.x = between(-0.3, 0.3);
    scene.target.y = between(-0.3, 0.3);
    scene.target.z = between(-0.3, 0.3);
    scene.field_of_view = between(0.5, 2);
    scene.detail = single(-4, -2);
    scene.colouring = even ? 0 : 1;
    scene.iterations = static_cast<int>(between(4, 40));
    if (fractal == "bulb") {
        scene.shape[1] = single(2, 6);
        scene.shape[2] = even ? std::floor(between(2, 12)) : single(2, 12);
    } else if (fractal == "box") {
        scene.shape[0] = even ? single(1.5, 3) : single(-2.5, -1.2);
        scene.shape[1] = single(0.2, 0.8);
        scene.shape[2] = single(0.8, 1.5);
    } else {
        scene.shape[0] = single(-0.6, 0.2);
        scene.shape[1] = single(-0.6, 0.6);
        scene.shape[2] = single(-0.4, 0.4);
        scene.escape = single(-0.5, 0.5);
    }
    return scene;
}

}  // namespace mandelmarch
