// SPDX-License-Identifier: Apache-2.0
// Renders a region of a picture, for prints larger than memory, or to divide the work among machines. In exact mode all
// bits are those of the whole picture. In fast mode openmp's rays begin near the hits of neighbouring pixels, which
// differ at a region's edge, so the last digits, and occasionally a pixel, differ.
#pragma once

#include <utility>

#include "core/render/backend.h"

namespace mandelmarch {

// A region, in pixels from the bottom left of the whole picture.
struct Region {
    int left = 0, bottom = 0;
    int width = 0, height = 0;
};

// Returns the max number of pixels in memory while rendering the region.
std::size_t pixels_in_memory(const Scene& scene, const Region& region);

// Renders the region. Strips of whole rows are rendered and then cropped, so a narrow region takes as long as its rows
// in full width. Throws the renderer's exceptions.
std::pair<Image, RenderStats> render_region(Renderer& renderer, const Scene& scene, const Region& region,
                                            Image::Layers layers, const Progress& progress = {});

}  // namespace mandelmarch
