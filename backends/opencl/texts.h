// SPDX-License-Identifier: Apache-2.0
// The kernel source as OpenCL C. The build generates one source file per fractal.
#pragma once

#include <string_view>

namespace mandelmarch::opencl {

// Returns the program for a fractal; empty if unknown.
std::string_view text_of(std::string_view fractal);

// Returns the program of the multiply-add peak.
std::string_view peak_text();

}  // namespace mandelmarch::opencl
