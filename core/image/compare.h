// SPDX-License-Identifier: Apache-2.0
// How much two pictures differ.
#pragma once

#include <cstdint>
#include <string>

#include "core/image/image.h"

namespace mandelmarch {

struct Comparison {
    std::uint64_t pixels = 0;
    std::uint64_t differing = 0;          // pixels with any byte different
    std::uint64_t visibly_differing = 0;  // pixels with a byte off by more than 2 of 255
    int largest = 0;                      // largest difference of two bytes, 0 to 255
    double psnr = 0;                      // dB over all bytes; +infinity for equal ones
    // Colours are compared where both images keep their values, depths where both have them. Values count as bits: NaN
    // equals itself, 0 and -0 differ. What is not compared counts 0.
    bool values_compared = false;
    bool depths_compared = false;
    std::uint64_t differing_colours = 0;
    std::uint64_t differing_depths = 0;
    std::uint64_t hit_or_miss = 0;  // pixels that hit in one picture only
    // The first pixel, from the bottom left, that differs in anything compared; -1: none does.
    std::int64_t first = -1;

    bool same() const { return first < 0; }
};

// Throws InputError if the sizes differ.
Comparison compare(const Image& a, const Image& b);

// Both values of the pixel with this index, for a message.
std::string describe_pixel(const Image& a, const Image& b, std::int64_t index);

// White where equal, darker the more the bytes differ; a difference of one is visible already.
Image difference_map(const Image& a, const Image& b);

}  // namespace mandelmarch
