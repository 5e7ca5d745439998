// SPDX-License-Identifier: Apache-2.0
// A part of a picture, in exact mode bit by bit as the whole picture has it: for prints that are larger than memory,
// and pictures that machines share. In fast mode openmp's rays begin near the hits of pixels around them, other ones at
// a region's edge, so that last digits differ, and now and then a pixel.
#pragma once

#include <utility>

#include "core/render/backend.h"

namespace mandelmarch {

// In pixels of the whole picture, from its bottom left.
struct Region {
    int left = 0, bottom = 0;
    int width = 0, height = 0;
};

// Pixels of the picture that are in memory at once while the region is drawn.
std::size_t pixels_in_memory(const Scene& scene, const Region& region);

// Draws the region of the scene's picture. Rows are drawn as wide as the whole picture, some at a time, and cut: a
// narrow region takes as long as all of its rows. Throws what the renderer throws.
std::pair<Image, RenderReport> render_region(Renderer& renderer, const Scene& scene, const Region& region,
                                             Image::Layers layers, const Progress& progress = {});

}  // namespace mandelmarch
