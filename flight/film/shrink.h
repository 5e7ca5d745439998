// SPDX-License-Identifier: Apache-2.0
// Averages samples to pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace mandelmarch {

// Returns the RGB bytes of `width` x `height` pixels, top row first. Each byte is the mean of the samples in the
// pixel's area, rounded to nearest (halves up). A sample that lies in several pixels is weighted by its area in each.
// The picture must be at least as large as the result. Uses up to `threads` threads.
std::vector<std::uint8_t> shrunk(const Image& picture, int width, int height, int threads);

}  // namespace mandelmarch
