// SPDX-License-Identifier: Apache-2.0
// Finds the stages of a fractal. stage_kernels.cpp is generated.
#pragma once

#include <string_view>

#include "bench/stage_kernel.h"
#include "core/render/backend.h"

namespace mandelmarch::bench {

// Throws Unavailable for a fractal without them. On a machine for which openmp has no packs `profile` is null.
template <class Real>
StageKernel<Real> stage_kernel(std::string_view fractal, Mode mode);

}  // namespace mandelmarch::bench
