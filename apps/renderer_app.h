// SPDX-License-Identifier: Apache-2.0
// What mandelbulb, mandelbox and render share: options, parameter file, picture, statistics.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch {

// The whole program, on whatever backends it is given. `fractal` is the fractal's name, or nullptr where --fractal
// chooses it. Returns an exit code or throws what core/base/error.h turns into one.
int render_program(const Registry& registry, const char* program, const char* fractal, int argc, char** argv);

}  // namespace mandelmarch
