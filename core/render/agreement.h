// SPDX-License-Identifier: Apache-2.0
// Measures how well a picture agrees with the expected one, for tests and benchmarks.
#pragma once

#include <string>

#include "core/image/compare.h"
#include "core/render/backend.h"

namespace mandelmarch {

// Levels of agreement. The best is first.
enum class Level {
    same_bits,   // colours and depths are equal bit for bit
    ulps,        // the same pixels are hits, and every value differs by at most a few ulp
    perceptual,  // few pixels differ visibly
    different
};

std::string_view name_of(Level level);  // "same bits", "ULP", "perceptual", "different"

struct Agreement {
    Level level = Level::different;
    Comparison comparison;
    bool numbers = false;  // both images have values, and the second has no NaN
    // Max difference of a colour or depth, in ulp of the precision; +infinity if one of the two values is NaN, or only
    // one is infinite.
    double largest_ulps = 0;
};

// Max differences for the levels `ulps` and `perceptual`.
inline constexpr double most_ulps = 4;
inline constexpr double most_visible_percent = 2;  // of the pixels; visible: a byte differs by more than 2 of 255

// Returns the level that a mode requires: same bits in exact mode, perceptual in fast mode.
Level level_required(Mode mode);

// Returns the agreement of `image` with `expected`. Both need values. Throws InputError if their sizes differ.
Agreement agreement(const Image& expected, const Image& image, Precision precision);

// Returns the command, for bash, that renders the scene. It lacks what parameter files lack, such as crop windows.
std::string render_command(const Scene& scene, const RendererOptions& options);

// Returns "same bits", the largest difference such as "3 ULP", or the visible difference such as "0.125 % off".
std::string summary(const Agreement& agreement);

}  // namespace mandelmarch
