// SPDX-License-Identifier: Apache-2.0
// The functions generated from ray.cpp.in (cmake/Kernels.cmake).
#pragma once

#include <string_view>

#include "apps/trace/trace.h"
#include "core/render/kernel_scene.h"

namespace mandelmarch {

// A function that traces the ray of pixel (trace.x, trace.y) and fills in the rest of `trace`.
template <class Real>
using TraceRay = void(const KernelScene<Real>& scene, Trace& trace);

// Returns a function by variant_name(); nullptr if this build does not contain the fractal.
template <class Real>
TraceRay<Real>* ray_of(std::string_view variant);

}  // namespace mandelmarch
