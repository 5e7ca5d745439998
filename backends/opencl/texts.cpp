// SPDX-License-Identifier: Apache-2.0
// Generated: the kernel text as OpenCL C, once per fractal.
#include "backends/opencl/texts.h"

namespace mandelmarch::opencl {

std::string_view text_of(std::string_view fractal)
{
@cases@    (void)fractal;
    return {};
}

std::string_view peak_text() { return R"opencl(@peak_text@)opencl"; }

}  // namespace mandelmarch::opencl
