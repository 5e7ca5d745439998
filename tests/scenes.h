// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/render/backend.h"
#include "core/scene/parameter_file.h"
#include "core/scene/random_scene.h"

namespace mandelmarch {

// Returns an official scene at another size, in pixels.
Scene official_scene(const std::string& short_name, int width, int height);

// Returns scenes that differ from the official ones: they have other powers, a negative scale, other radii, other up
// vectors, or a camera inside the fractal.
std::vector<NamedScene> odd_scenes();

// Returns scenes of every fractal with random cameras, shapes and iterations; the same seed gives the same scenes.
std::vector<NamedScene> random_scenes(int per_fractal, unsigned seed);

// Returns a look in which every number of the kernel has an effect.
LookValues cloudy_look();

// Returns the command that traces a pixel of the scene, given by its index.
std::string trace_command(const Scene& scene, const RendererOptions& options, std::int64_t pixel);

// Renders a picture with all layers.
Image render(const Backend& backend, const Scene& scene, const RendererOptions& options);

}  // namespace mandelmarch
