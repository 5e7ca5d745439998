// SPDX-License-Identifier: Apache-2.0
// The table of programs. fractals.inc has a line MM_FRACTAL(name) for each fractal.
#include "backends/opencl/texts.h"

namespace mandelmarch::opencl {

#define MM_FRACTAL(name) extern const std::string_view text_##name;
#include "fractals.inc"
#undef MM_FRACTAL
extern const std::string_view text_peak;

std::string_view text_of(std::string_view fractal)
{
#define MM_FRACTAL(name) \
    if (fractal == #name) return text_##name;
#include "fractals.inc"
#undef MM_FRACTAL
    return {};
}

std::string_view peak_text() { return text_peak; }

}  // namespace mandelmarch::opencl
