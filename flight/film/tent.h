// SPDX-License-Identifier: Apache-2.0
// A filter for pictures of one sample a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace mandelmarch {

// RGB from the top row: each byte is 6/10 of the picture's and 1/10 of each of its four neighbours', rounded, halves
// up; beyond an edge the edge counts. It takes what flickers from single samples at a twentieth of the sharpness
// (docs/notes/experiments.md). The picture has row 0 at the bottom, as images do. On up to `threads` threads, 0: all.
std::vector<std::uint8_t> softened(const Image& picture, int threads);

}  // namespace mandelmarch
