// SPDX-License-Identifier: Apache-2.0
// A filter for pictures with one sample per pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace mandelmarch {

// Returns the filtered picture's RGB bytes, top row first. Each byte is 6/10 of the pixel's own value plus 1/10 of each
// of its four neighbours' values, rounded to nearest (halves up). At the edges, the pixel itself replaces a missing
// neighbour. The filter removes the flicker of single samples and costs a twentieth of the sharpness
// (docs/notes/experiments.md). Uses up to `threads` threads.
std::vector<std::uint8_t> softened(const Image& picture, int threads);

}  // namespace mandelmarch
