// SPDX-License-Identifier: Apache-2.0
// The official parameter files, embedded, so that the program runs anywhere. Generated from params*.dat.
#pragma once

#include <string_view>

namespace mandelmarch::bench {

// The text of the file for a fractal's nickname; empty if there is none.
std::string_view official_parameters(std::string_view nickname);

}  // namespace mandelmarch::bench
