// SPDX-License-Identifier: Apache-2.0
// MM_DISPATCH(name, targets) is the function that HWY_EXPORT(name) exports for the best instruction set in `targets`.
// Highway's HWY_DYNAMIC_DISPATCH is not used, because it chooses one instruction set for the whole process.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"

#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
#define MM_DISPATCH(name, targets) (static_cast<void>(targets), &HWY_STATIC_DISPATCH(name))
#else
#define MM_DISPATCH(name, targets) (HWY_DISPATCH_TABLE(name)[mandelmarch::openmp::dispatch_index(targets)])

namespace mandelmarch::openmp {

// Declared static, because the result depends on the instruction sets for which the translation unit is compiled.
static inline std::size_t dispatch_index(std::int64_t targets)
{
    hwy::ChosenTarget chosen;
    chosen.Update(targets);
    return chosen.GetIndex();
}

}  // namespace mandelmarch::openmp
#endif
