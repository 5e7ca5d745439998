// SPDX-License-Identifier: Apache-2.0
// Averages samples to pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace mandelmarch {

// Returns RGB of `width` x `height` pixels, from the top row. Each byte is the mean of the picture's bytes over the
// pixel's area, rounded, halves up; a sample that lies in several pixels is weighted by its area in each. The picture
// (row 0 at the bottom, as in all images) must be at least as large as the result. Uses up to `threads` threads.
std::vector<std::uint8_t> shrunk(const Image& picture, int width, int height, int threads);

}  // namespace mandelmarch
