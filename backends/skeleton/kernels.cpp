// SPDX-License-Identifier: Apache-2.0
// The table of kernels. fractals.inc has a line MM_FRACTAL(name) for each fractal.
#include "backends/skeleton/kernel.h"

namespace mandelmarch::skeleton {

#define MM_FRACTAL(name) extern const Kernel name;
#include "fractals.inc"
#undef MM_FRACTAL

const Kernel* kernel_of(std::string_view name)
{
#define MM_FRACTAL(fractal) \
    if (name == #fractal) return &fractal;
#include "fractals.inc"
#undef MM_FRACTAL
    return nullptr;
}

}  // namespace mandelmarch::skeleton
