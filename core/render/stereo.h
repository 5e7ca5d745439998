// SPDX-License-Identifier: Apache-2.0
// Two eyes side by side in one picture: the left eye's in its left half.
#pragma once

#include "core/render/backend.h"

namespace mandelmarch {

// Things at this distance, in distances of the eyes, appear at the screen's: nearer ones in front of it.
inline constexpr double screen_distance = 60;

// The scene of one eye: half as wide, moved sideways by half of `eyes`, which is the eyes' distance, and looking
// through the same window at the screen's distance. `side`: -1 left, 1 right.
Scene of_eye(const Scene& scene, double eyes, int side);

// Draws `scene` for two eyes into `image`, which has the scene's size, an even width. Throws InputError for another
// width, for a part of a picture and for an equirectangular one, whose eyes would have to turn with the pixel.
RenderReport render_stereo(Renderer& renderer, const Scene& scene, double eyes, Image& image,
                           const Progress& progress = {});

}  // namespace mandelmarch
