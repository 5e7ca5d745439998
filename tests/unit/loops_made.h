// SPDX-License-Identifier: Apache-2.0
// The loop iterations that the kernel of each fractal makes.
#pragma once

#include <string_view>

#include "core/render/schedule.h"

namespace mandelmarch {

// Renders the scene in exact mode and in fast mode. Returns the largest loop counts of the rays.
using MadeLoops = Loops(const Scene& scene);

// Returns the function of the fractal NAME.
MadeLoops* loops_made(std::string_view fractal);

}  // namespace mandelmarch
