// SPDX-License-Identifier: Apache-2.0
// Averages ray samples to pixels.
#pragma once

#include "core/image/image.h"

namespace mandelmarch {

// Returns a picture with pixels that are means of `side` x `side` ray samples, for bytes (halves rounded up) and for
// displayed colours. A pixel's depth is the min over its ray samples; steps and iterations are means, rounded down.
// Width and height must be multiples of `side`.
Image averaged(const Image& samples, int side);

}  // namespace mandelmarch
