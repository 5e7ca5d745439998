// SPDX-License-Identifier: Apache-2.0
// The program behind mandelbulb, mandelbox and render.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch {

// The main function of these programs. `fractal`: the fractal's name; nullptr if the option --fractal gives it.
// `backends`: the function program_backends() (backends/all.h), passed in because this library does not link the
// backends.
int renderer_main(const char* program, const char* fractal, Registry (*backends)(int, char**), int argc, char** argv);

}  // namespace mandelmarch
