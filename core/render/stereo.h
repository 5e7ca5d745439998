// SPDX-License-Identifier: Apache-2.0
// Side-by-side stereo, with the left eye's picture in the left half.
#pragma once

#include "core/render/backend.h"

namespace mandelmarch {

// Distance at which objects appear at the screen, in eye distances; closer objects appear in front of it.
inline constexpr double screen_distance = 60;

// Returns the scene of one eye: half as wide, moved sideways by half of `eyes` (the eye distance), with the same window
// at the screen's distance. `side`: -1 left, 1 right.
Scene of_eye(const Scene& scene, double eyes, int side);

// Renders `scene` for two eyes into `image`, which has the scene's size and an even width. Throws InputError for an odd
// width, a crop window, or an equirectangular picture, in which the eyes would have to turn with the pixel.
RenderReport render_stereo(Renderer& renderer, const Scene& scene, double eyes, Image& image,
                           const Progress& progress = {});

}  // namespace mandelmarch
