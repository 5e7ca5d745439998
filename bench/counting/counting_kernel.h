// SPDX-License-Identifier: Apache-2.0
// Interface between counting.cpp and the counting kernels.
#pragma once

#include "bench/counting/counting.h"
#include "core/render/kernel_scene.h"

namespace mandelmarch::bench {

// Sums over pixels, from which a Count is computed.
struct PixelCount {
    std::array<Operations, stage_count> stages;
    Work work;
    std::uint64_t hits = 0;
};

// A function that renders pixel (i, j), adds its counts to `to`, and appends one number to `steps` for each step of the
// pixel's ray: the step's DE iterations.
template <class Real>
using CountPixel = void(const KernelScene<Real>& scene, int i, int j, PixelCount& to, RaySteps& steps);

// Returns the function generated from counting.cpp.in for "FRACTAL_PRECISION" (cmake/Kernels.cmake), or nullptr if this
// build does not contain the fractal.
template <class Real>
CountPixel<Real>* counting_kernel(std::string_view variant);

}  // namespace mandelmarch::bench
