// SPDX-License-Identifier: Apache-2.0
// Draws a part of a picture, for prints that are larger than memory, or shared by several machines. In exact mode all
// bits are those of the whole picture. In fast mode openmp's rays begin near the hits of neighbouring pixels, which are
// others at a region's edge, so that last digits differ, and now and then a pixel.
#pragma once

#include <utility>

#include "core/render/backend.h"

namespace mandelmarch {

// A part of a picture, in pixels from the bottom left of the whole picture.
struct Region {
    int left = 0, bottom = 0;
    int width = 0, height = 0;
};

// Pixels of the picture that are in memory at once while the region is drawn.
std::size_t pixels_in_memory(const Scene& scene, const Region& region);

// Draws the region of the scene's picture. Strips of whole rows are drawn and then cut: a narrow region takes as long
// as its rows in full width. Throws the renderer's exceptions.
std::pair<Image, RenderReport> render_region(Renderer& renderer, const Scene& scene, const Region& region,
                                             Image::Layers layers, const Progress& progress = {});

}  // namespace mandelmarch
