// SPDX-License-Identifier: Apache-2.0
// Scenes of the studies: the official ones and others.
#pragma once

#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch::bench {

// A scene of the study box-vs-bulb. All fractals have views of the same names, "official" among them.
struct View {
    std::string_view name;
    Scene scene;
};

// Returns the views of a fractal, at a size in pixels.
std::vector<View> views_of(std::string_view short_name, int width, int height);

}  // namespace mandelmarch::bench
