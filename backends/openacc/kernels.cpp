// SPDX-License-Identifier: Apache-2.0
// The table of kernels. fractals.inc is the list of fractals, a line of MM_FRACTAL for each.
#include "backends/openacc/kernels.h"

#include <fmt/format.h>

#include "core/base/error.h"

#define MM_MARCH(fractal, precision, mode) march_##fractal##_##precision##_##mode
#define MM_SHADE(fractal, precision, mode) shade_##fractal##_##precision##_##mode
#define MM_DECLARE(fractal, precision, mode)                              \
    void MM_MARCH(fractal, precision, mode)(const void* job, int blocks); \
    void MM_SHADE(fractal, precision, mode)(const void* job, int blocks);

extern "C" {
#define MM_FRACTAL(name)            \
    MM_DECLARE(name, float, exact)  \
    MM_DECLARE(name, float, fast)   \
    MM_DECLARE(name, double, exact) \
    MM_DECLARE(name, double, fast)
#include "fractals.inc"
#undef MM_FRACTAL
}

namespace mandelmarch::openacc {
namespace {

[[noreturn]] void refuse(std::string_view fractal)
{
    throw Unavailable(fmt::format("backend openacc: it does not draw the {}", fractal));
}

}  // namespace

#define MM_KERNELS(name, precision, mode) \
    Kernels { MM_MARCH(name, precision, mode), MM_SHADE(name, precision, mode) }
#define MM_RETURN(name, precision) \
    if (fractal == #name)          \
        return mode == Mode::exact ? MM_KERNELS(name, precision, exact) : MM_KERNELS(name, precision, fast);

template <>
Kernels kernels_of<float>(std::string_view fractal, Mode mode)
{
#define MM_FRACTAL(name) MM_RETURN(name, float)
#include "fractals.inc"
#undef MM_FRACTAL
    refuse(fractal);
}

template <>
Kernels kernels_of<double>(std::string_view fractal, Mode mode)
{
#define MM_FRACTAL(name) MM_RETURN(name, double)
#include "fractals.inc"
#undef MM_FRACTAL
    refuse(fractal);
}

}  // namespace mandelmarch::openacc
