// SPDX-License-Identifier: Apache-2.0
// A square of finished pixels, passed from a backend to an image. Contains plain data only, because translation units
// that are compiled for one instruction set include it, and they must not contain code of the standard library.
#pragma once

namespace mandelmarch {

inline constexpr int tile_side = 16;  // pixels
inline constexpr int tile_pixels = tile_side * tile_side;

inline constexpr int real_planes = 4;   // red, green, blue, depth
inline constexpr int whole_planes = 3;  // steps, DE evaluations, iterations

// Real is the kernel's floating-point type. Pixel (x, y) has index y * tile_side + x; y grows upwards.
template <class Real>
struct Tile {
    Real red[tile_pixels];  // 0 to 1, as displayed
    Real green[tile_pixels];
    Real blue[tile_pixels];
    Real depth[tile_pixels];  // +infinity: no hit
    int steps[tile_pixels];
    int de_calls[tile_pixels];
    int iterations[tile_pixels];
};

}  // namespace mandelmarch
