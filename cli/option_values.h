// SPDX-License-Identifier: Apache-2.0
// Parsers for values of command line options. Each throws InputError with the option, the given and the expected value.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "core/render/region.h"
#include "core/scene/scene.h"
#include "core/image/image.h"

namespace mandelmarch {

// Parses an integer from `low` to `high`. `name`: the option's, without dashes.
int whole_option(const std::string& name, const std::string& text, int low, int high);

// Parses an integer from 0 to `high` that may not fit into an int.
std::uint64_t large_option(const std::string& name, const std::string& text, std::uint64_t high);

// Parses a number from `low` to `high`.
double real_option(const std::string& name, const std::string& text, double low, double high);

// Parses two integers from `low` to `high`, separated by the character `between`. `expected`: for the error message.
std::pair<int, int> pair_option(const std::string& name, const std::string& text, char between, int low, int high,
                                const std::string& expected);

// Return standard input or output for `-`, and all other names unchanged. A file named `-` can be given as `./-`.
std::string input_name(const std::string& name);
std::string output_name(const std::string& name);

// Parses a picture's size, WIDTHxHEIGHT in pixels or a name such as 1080p. No side may exceed `most_side`.
std::pair<int, int> size_option(const std::string& text, int most_side = max_side);

// Parses X,Y,WIDTHxHEIGHT or X,Y,WIDTH,HEIGHT, a part of a `width` x `height` picture in pixels from the bottom left.
Region region_option(const std::string& text, int width, int height);

}  // namespace mandelmarch
