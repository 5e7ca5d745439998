// SPDX-License-Identifier: Apache-2.0
// Agreement of a picture with the expected one, for tests and benchmarks.
#pragma once

#include <string>

#include "core/image/compare.h"
#include "core/render/backend.h"

namespace mandelmarch {

// Levels of agreement, best first.
enum class Level {
    same_bits,   // every bit of colour and depth
    ulps,        // the same hits, and every value within a few ulp
    perceptual,  // few pixels differ visibly
    different
};

std::string_view name_of(Level level);  // "same bits", "ULP", "perceptual", "different"

struct Agreement {
    Level level = Level::different;
    Comparison comparison;
    bool numbers = false;     // both have values, and the second no NaN
    double largest_ulps = 0;  // of a colour or depth, in ulp of the precision; +infinity if one is NaN
};

// Limits of the levels.
inline constexpr double most_ulps = 4;
inline constexpr double most_visible_percent = 2;  // pixels with a byte that differs by more than 2 of 255

// Returns the level that a mode requires: same bits in exact mode, perceptual in fast mode.
Level level_required(Mode mode);

// Both images need values. Throws InputError if the sizes differ.
Agreement agreement(const Image& expected, const Image& image, Precision precision);

// Returns "same bits", or the level with the number of differing pixels.
std::string summary(const Agreement& agreement);

}  // namespace mandelmarch
