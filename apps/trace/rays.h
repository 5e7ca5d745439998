// SPDX-License-Identifier: Apache-2.0
// The table of what is generated from ray.cpp.in.
#pragma once

#include <string_view>

#include "apps/trace/trace.h"

namespace mandelmarch {

// Fills in the trace of its pixel, of which precision and mode are known. `scene` is the text's Scene.
using TraceRay = void (*)(const void* scene, Trace& trace);

// nullptr for a fractal without one.
TraceRay ray_of(std::string_view fractal, Precision precision, Mode mode);

}  // namespace mandelmarch
