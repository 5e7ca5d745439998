// SPDX-License-Identifier: Apache-2.0
// MM_DISPATCH(name, targets): the function of HWY_EXPORT(name) for the best of a set of instruction sets.
// HWY_DYNAMIC_DISPATCH would use the process-wide choice.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"

#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
#define MM_DISPATCH(name, targets) (static_cast<void>(targets), &HWY_STATIC_DISPATCH(name))
#else
#define MM_DISPATCH(name, targets) (HWY_DISPATCH_TABLE(name)[mandelmarch::openmp::dispatch_index(targets)])

namespace mandelmarch::openmp {

// Static: it depends on the instruction sets of the translation unit.
static inline std::size_t dispatch_index(std::int64_t targets)
{
    hwy::ChosenTarget chosen;
    chosen.Update(targets);
    return chosen.GetIndex();
}

}  // namespace mandelmarch::openmp
#endif
