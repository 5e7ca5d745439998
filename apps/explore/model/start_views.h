// SPDX-License-Identifier: Apache-2.0
// Views to start from: the parameter files of the folder scenes, which the build embeds in the program.
#pragma once

#include <span>
#include <string_view>

namespace mandelmarch::explore {

struct StartView {
    std::string_view name;     // such as "reef"
    std::string_view fractal;  // the fractal's name
    std::string_view text;     // text of the parameter file
};

// Returns the views whose fractals this build has, sorted by name. May be empty.
std::span<const StartView> start_views();

}  // namespace mandelmarch::explore
