// SPDX-License-Identifier: Apache-2.0
// Scenes for tests.
#pragma once

#include <string>

#include "core/render/backend.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch {

// An official scene at another size, in pixels.
Scene official_scene(const std::string& nickname, int width, int height);

// Scenes away from the official ones: other powers, a negative scale, other radii, other up vectors, a camera inside.
struct NamedScene {
    std::string name;
    Scene scene;
};
std::vector<NamedScene> odd_scenes();

// Scenes of every fractal with cameras, shapes and iterations drawn at random; the same seed gives the same scenes.
std::vector<NamedScene> random_scenes(int per_fractal, unsigned seed);

// The picture with all layers.
Image render(const Backend& backend, const Scene& scene, const RendererOptions& options);

}  // namespace mandelmarch
