// SPDX-License-Identifier: Apache-2.0
// The program behind mandelbulb, mandelbox and render.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch {

// Runs the program with the registry's backends. `fractal`: the fractal's name; nullptr: the option --fractal gives it.
// Returns an exit code, or throws an exception that run_program() (core/base/error.h) converts to one.
int render_program(const Registry& registry, const char* program, const char* fractal, int argc, char** argv);

}  // namespace mandelmarch
