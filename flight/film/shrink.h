// SPDX-License-Identifier: Apache-2.0
// Pixels of a film's pictures, computed from samples. If there are several samples per pixel, a pixel is their mean. If
// there is one sample per pixel, a filter is applied to the samples.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace mandelmarch {

// Returns the RGB bytes of `width` x `height` pixels, top row first. Each byte is the mean of the samples in the
// pixel's area, rounded to nearest (halves up). A sample that lies in several pixels is weighted by its area in each.
// The picture must be at least as large as the result. Uses up to `threads` threads.
std::vector<std::uint8_t> shrunk(const Image& picture, int width, int height, int threads);

// Returns the filtered picture's RGB bytes, top row first. Each byte is 6/10 of the pixel's own value plus 1/10 of each
// of its four neighbours' values, rounded to nearest (halves up). At the edges, the pixel itself replaces a missing
// neighbour. The filter removes the flicker of single samples and costs a twentieth of the sharpness
// (docs/notes/experiments.md). Uses up to `threads` threads.
std::vector<std::uint8_t> softened(const Image& picture, int threads);

}  // namespace mandelmarch
