// SPDX-License-Identifier: Apache-2.0
// Tiles and planes of pixels. Contains plain data only, because translation units that are compiled for one instruction
// set include it, and they must not contain code of the standard library.
#pragma once

namespace mandelmarch {

inline constexpr int tile_side = 16;  // pixels
inline constexpr int tile_pixels = tile_side * tile_side;

inline constexpr int real_planes = 4;   // red, green, blue, depth
inline constexpr int whole_planes = 3;  // steps, DE evaluations, iterations

}  // namespace mandelmarch
