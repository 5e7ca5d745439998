// SPDX-License-Identifier: Apache-2.0
// The table of functions generated from ray.cpp.in.
#pragma once

#include <string_view>

#include "apps/trace/trace.h"

namespace mandelmarch {

// A function that traces the ray of pixel (trace.x, trace.y) and fills in the rest of `trace`. `scene` points to the
// kernel's Scene in the function's precision.
using TraceRay = void (*)(const void* scene, Trace& trace);

// Returns the function for "FRACTAL_PRECISION_MODE", such as "mandelbox_float_exact", or nullptr if this build does not
// contain the fractal.
TraceRay ray_of(std::string_view variant);

}  // namespace mandelmarch
