// SPDX-License-Identifier: Apache-2.0
// Side-by-side stereo pictures. The left eye's picture is the left half.
#pragma once

#include "core/render/backend.h"

namespace mandelmarch {

// Distance from the eyes to the screen, as a multiple of the distance between the eyes. Objects that are closer appear
// in front of the screen.
inline constexpr double screen_distance = 60;

// Returns the scene of one eye. Its picture has half the width. The camera is moved sideways by half of `eyes`, the
// distance between the eyes, and the picture is cropped so that both eyes see the same window at the screen's distance.
// `side`: -1 for the left eye, 1 for the right.
Scene of_eye(const Scene& scene, double eyes, int side);

// Number of strips into which each eye's equirectangular picture is divided. The pair of eyes turns from strip to strip
// (omnidirectional stereo), so that both eyes look straight ahead at the strip's middle.
inline constexpr int strips_around = 180;

// Returns the scene of one strip for one eye: `width` columns of the eye's equirectangular picture, from column `left`
// on. `scene` has the size of the pictures of both eyes together. `eyes` and `side` are as in of_eye().
Scene strip_of_eye(const Scene& scene, double eyes, int side, int left, int width);

// Renders `scene` for two eyes into `image`, which has the scene's size. Throws InputError if the width is odd or the
// scene has a crop window.
RenderStats render_stereo(Renderer& renderer, const Scene& scene, double eyes, Image& image,
                          const Progress& progress = {});

}  // namespace mandelmarch
