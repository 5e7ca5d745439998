// SPDX-License-Identifier: Apache-2.0
// Generated from the lists of fractals, precisions and modes.
#include "backends/openacc/kernels.h"

#include <fmt/format.h>

#include "core/base/error.h"

extern "C" {
@declarations@}

namespace mandelmarch::openacc {
namespace {

[[noreturn]] void refuse(std::string_view fractal)
{
    throw Unavailable(fmt::format("backend openacc: it does not draw the {}", fractal));
}

}  // namespace

template <>
Kernels kernels_of<float>(std::string_view fractal, Mode mode)
{
@rows_float@    refuse(fractal);
}

template <>
Kernels kernels_of<double>(std::string_view fractal, Mode mode)
{
@rows_double@    refuse(fractal);
}

}  // namespace mandelmarch::openacc
