// SPDX-License-Identifier: Apache-2.0
// Values of command line options. Each throws InputError, which names the option, what was given and what is expected.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "core/render/region.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// A whole number from `low` to `high`; `name` without the dashes.
int whole_option(const std::string& name, const std::string& text, int low, int high);

// A whole number from 0 to `high`, for what an int does not hold.
std::uint64_t large_option(const std::string& name, const std::string& text, std::uint64_t high);

// A number from `low` to `high`.
double real_option(const std::string& name, const std::string& text, double low, double high);

// Two whole numbers from `low` to `high` with a character between them; `expected` says so in words.
std::pair<int, int> pair_option(const std::string& name, const std::string& text, char between, int low, int high,
                                const std::string& expected);

// `-` means standard input or output, as usual on Unix; all other names are unchanged. A file named `-` is `./-`.
std::string input_name(const std::string& name);
std::string output_name(const std::string& name);

// WIDTHxHEIGHT of a picture, in pixels; no side may exceed `most_side`.
std::pair<int, int> size_option(const std::string& text, int most_side = max_side);

// X,Y,WIDTHxHEIGHT or X,Y,WIDTH,HEIGHT: a part of a `width` x `height` picture, in pixels from the bottom left.
Region region_option(const std::string& text, int width, int height);

}  // namespace mandelmarch
