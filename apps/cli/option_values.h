// SPDX-License-Identifier: Apache-2.0
// Parsers for values of command line options. If a value is invalid, they throw InputError with a message that names
// the option, the given value and the allowed values.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <utility>

#include "core/render/region.h"
#include "core/scene/scene.h"
#include "core/image/image.h"

namespace mandelmarch {

// Return checks of an option whose value is a number from `low` to `high`, for CLI::Option::check().
CLI::Validator whole(std::int64_t low, std::int64_t high);
CLI::Validator real(double low, double high);

// Parses an integer from `low` to `high`. `name`: the option's name without dashes.
int whole_option(const std::string& name, const std::string& text, int low, int high);

// Parses two integers from `low` to `high`, separated by the character `between`. `expected`: the allowed values, in
// words for the error message.
std::pair<int, int> pair_option(const std::string& name, const std::string& text, char between, int low, int high,
                                const std::string& expected);

// Return the device file of standard input or output if the name is `-`, and any other name unchanged. A file that is
// called `-` can be given as `./-`.
std::string input_name(const std::string& name);
std::string output_name(const std::string& name);

// Parses a picture's size: WIDTHxHEIGHT in pixels, or a name such as 4k. Neither side may exceed `most_side`.
// `panoramas`: the number of equirectangular pictures side by side, 0 for perspective pictures. With panoramas, a name
// stands for this width of each and for half of it as the height.
std::pair<int, int> size_option(const std::string& text, int most_side = max_side, int panoramas = 0);

// Parses a region of a picture of `width` x `height` pixels: X,Y,WIDTH,HEIGHT or X,Y,WIDTHxHEIGHT. X,Y is the region's
// bottom left pixel, counted from the picture's bottom left.
Region region_option(const std::string& text, int width, int height);

}  // namespace mandelmarch
