// SPDX-License-Identifier: Apache-2.0
// Averages ray samples to pixels.
#pragma once

#include "core/image/image.h"

namespace mandelmarch {

// Returns a picture in which each pixel is the mean of `side` x `side` ray samples. Bytes are means, rounded to the
// nearest integer, halves up. Displayed colours are means. A pixel's depth is the min over its ray samples; steps and
// iterations are means, rounded down. The width and height of `samples` must be multiples of `side`.
Image averaged(const Image& samples, int side);

}  // namespace mandelmarch
