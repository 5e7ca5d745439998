// SPDX-License-Identifier: Apache-2.0
// Generated from the list of fractals.
#include "backends/skeleton/kernel.h"

namespace mandelmarch::skeleton {

@declarations@
const Kernel* kernel_of(std::string_view name)
{
@rows@    return nullptr;
}

}  // namespace mandelmarch::skeleton
