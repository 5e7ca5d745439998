// SPDX-License-Identifier: Apache-2.0
// From samples to pixels.
#pragma once

#include "core/image/image.h"

namespace mandelmarch {

// The picture whose pixels are the means of `side` x `side` of this one's: of bytes, rounded, halves up, and of colours
// as displayed. A pixel's depth is the least of its samples'; steps and iterations are means, rounded down. Width and
// height have to be multiples of `side`.
Image averaged(const Image& samples, int side);

}  // namespace mandelmarch
