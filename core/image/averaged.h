// SPDX-License-Identifier: Apache-2.0
// Averages samples to pixels.
#pragma once

#include "core/image/image.h"

namespace mandelmarch {

// The picture whose pixels are means of `side` x `side` samples, both of bytes (halves rounded up) and of colours as
// displayed. A pixel's depth is the smallest of its samples; steps and iterations are means, rounded down. Width and
// height must be multiples of `side`.
Image averaged(const Image& samples, int side);

}  // namespace mandelmarch
