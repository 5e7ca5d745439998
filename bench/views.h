// SPDX-License-Identifier: Apache-2.0
// Scenes that are measured: the official ones and others.
#pragma once

#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch::bench {

// The official scene of a fractal at a size in pixels, as the repository's parameter file has it.
Scene official_scene_of(std::string_view nickname, int width, int height);

// The official view of a fractal and others, for the study box-vs-bulb: fractals have them under the same names.
struct View {
    std::string_view name;
    Scene scene;
};
std::vector<View> views_of(std::string_view nickname, int width, int height);

}  // namespace mandelmarch::bench
