// SPDX-License-Identifier: Apache-2.0
// Whether a picture is the one that was expected, and how well: what tests and benchmarks ask before they trust it.
#pragma once

#include <string>

#include "core/image/compare.h"
#include "core/render/backend.h"

namespace mandelmarch {

// The levels of agreement, the best first.
enum class Level {
    same_bits,   // every bit of colour and depth
    ulps,        // the same hits, and every value within a few units in the last place
    perceptual,  // few pixels are off by more than an eye could see
    different
};

std::string_view name_of(Level level);  // "same bits", "ULP", "perceptual", "different"

struct Agreement {
    Level level = Level::different;
    Comparison comparison;
    bool numbers = false;     // both have values, and the second no NaN
    double largest_ulps = 0;  // of a colour or depth, in the precision's units; +infinity where one is not a number
};

// The bounds of the levels.
inline constexpr double most_ulps = 4;
inline constexpr double most_visible_percent = 2;  // pixels with a byte off by more than 2 of 255

// The level that a mode asks for: same bits in exact mode, perceptual in fast mode.
Level level_required(Mode mode);

// Both images need their values and the same size. Throws InputError where the sizes differ.
Agreement agreement(const Image& expected, const Image& image, Precision precision);

// "same bits", or the level with how many pixels differ.
std::string summary(const Agreement& agreement);

}  // namespace mandelmarch
