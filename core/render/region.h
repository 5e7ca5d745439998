// SPDX-License-Identifier: Apache-2.0
// Renders a region of a picture, for prints that are larger than memory, or to divide the work among machines. In
// exact mode every bit is the same as in the whole picture. In fast mode, rays may begin near the hits of neighbouring
// pixels. At the edge of a region other neighbours are available, so the last digits of pixels, and
// occasionally a whole pixel, differ.
#pragma once

#include <utility>

#include "core/render/backend.h"

namespace mandelmarch {

// A region of a picture, in pixels. left and bottom are counted from the bottom left of the whole picture.
struct Region {
    int left = 0, bottom = 0;
    int width = 0, height = 0;
};

// Returns the max number of pixels that are in memory while the region is rendered.
std::size_t pixels_in_memory(const Scene& scene, const Region& region);

// Renders the region. Whole rows of the picture are rendered and then cropped, so a narrow region takes as long as one
// of full width. Throws the renderer's exceptions.
std::pair<Image, RenderStats> render_region(Renderer& renderer, const Scene& scene, const Region& region,
                                            Image::Layers layers, const Progress& progress = {});

}  // namespace mandelmarch
