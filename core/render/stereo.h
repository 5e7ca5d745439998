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

// An equirectangular picture of two eyes has this many strips for each eye. The eyes turn with the strip
// (omnidirectional stereo), so that both look straight ahead at its middle.
inline constexpr int strips_around = 180;

// Returns the scene of one eye's strip: `width` columns of the eye's equirectangular picture from column `left` on.
// `scene` has the size of both eyes' pictures; `eyes` and `side` are those of of_eye().
Scene strip_of_eye(const Scene& scene, double eyes, int side, int left, int width);

// Renders `scene` for two eyes into `image`, which has the scene's size. Throws InputError for an odd width and for a
// crop window.
RenderStats render_stereo(Renderer& renderer, const Scene& scene, double eyes, Image& image,
                          const Progress& progress = {});

}  // namespace mandelmarch
