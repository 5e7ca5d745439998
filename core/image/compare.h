// SPDX-License-Identifier: Apache-2.0
// Differences of two pictures.
#pragma once

#include <cstdint>
#include <string>

#include "core/image/image.h"

namespace mandelmarch {

struct Comparison {
    std::uint64_t pixels = 0;
    std::uint64_t differing = 0;          // pixels that differ in any byte
    std::uint64_t visibly_differing = 0;  // pixels with a byte that differs by more than 2 of 255
    int largest = 0;                      // largest difference of a byte, 0 to 255
    double psnr = 0;                      // peak signal-to-noise ratio over all bytes, dB; +infinity if all are equal
    // Colours are compared if both images have values, depths if both have depths. Values are compared bit for bit: NaN
    // equals itself, and 0 and -0 differ. The counts of values that are not compared are 0.
    bool values_compared = false;
    bool depths_compared = false;
    std::uint64_t differing_colours = 0;
    std::uint64_t differing_depths = 0;
    std::uint64_t hit_or_miss = 0;  // pixels that are hits in only one of the pictures
    // Index of the first pixel that differs, in bytes or in compared values, counted from the bottom left; -1: none.
    std::int64_t first = -1;

    bool same() const { return first < 0; }
};

// Compares two pictures. Throws InputError if their sizes differ.
Comparison compare(const Image& a, const Image& b);

// Returns the values of both pictures at the pixel with this index, as text for a message.
std::string describe_pixel(const Image& a, const Image& b, std::int64_t index);

// Returns a picture that is white where the bytes are equal, and darker for larger differences. Even a difference of 1
// is visible.
Image difference_map(const Image& a, const Image& b);

}  // namespace mandelmarch
