// SPDX-License-Identifier: Apache-2.0
// The kernel text as OpenCL C. A source with the text is generated for each fractal.
#pragma once

#include <string_view>

namespace mandelmarch::opencl {

// The whole program for a fractal; empty if there is none.
std::string_view text_of(std::string_view fractal);

// The whole program of the multiply-add peak.
std::string_view peak_text();

}  // namespace mandelmarch::opencl
