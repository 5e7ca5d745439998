// SPDX-License-Identifier: Apache-2.0
// The table of functions generated from ray.cpp.in.
#pragma once

#include <string_view>

#include "apps/trace/trace.h"

namespace mandelmarch {

// Traces the ray of pixel (trace.x, trace.y) and fills in the rest of `trace`. `scene`: the kernel's Scene of that
// precision.
using TraceRay = void (*)(const void* scene, Trace& trace);

// Returns nullptr if the fractal was not built.
TraceRay ray_of(std::string_view fractal, Precision precision, Mode mode);

}  // namespace mandelmarch
