// SPDX-License-Identifier: Apache-2.0
// Two broken versions of the skeleton's kernel: one has a wrong fold, the other is compiled with contraction.
#pragma once

#include "backends/skeleton/kernel.h"

namespace mandelmarch::skeleton {

// wrong_fold() and contracted() return a broken kernel. `variant`: "wrong_fold_PRECISION" or "contracted_PRECISION".
template <class Real>
DrawBand<Real>* wrong_fold(std::string_view variant);
template <class Real>
DrawBand<Real>* contracted(std::string_view variant);

}  // namespace mandelmarch::skeleton
