// SPDX-License-Identifier: Apache-2.0
// A filter for pictures with one sample per pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace mandelmarch {

// Returns RGB from the top row. Each byte is 6/10 of the picture's and 1/10 of each of its four neighbours', rounded,
// halves up; edges are repeated. This removes flicker of single samples and costs a twentieth of the sharpness
// (docs/notes/experiments.md). The picture has row 0 at the bottom, as all images. Uses up to `threads` threads.
std::vector<std::uint8_t> softened(const Image& picture, int threads);

}  // namespace mandelmarch
