// SPDX-License-Identifier: Apache-2.0
// From samples to pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace mandelmarch {

// RGB of `width` x `height` pixels, from the top row: each the mean of the picture's bytes over its area, where a
// sample that lies in two pixels counts in each by its share; rounded, halves up. The picture (row 0 at the bottom, as
// images are) is at least as large as the result. On up to `threads` threads, 0: all.
std::vector<std::uint8_t> shrunk(const Image& picture, int width, int height, int threads);

}  // namespace mandelmarch
