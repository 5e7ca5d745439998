// SPDX-License-Identifier: Apache-2.0
// The program behind mandelbulb, mandelbox and render.
#pragma once

namespace mandelmarch {

// The main function of these programs. `fractal`: the fractal's name; nullptr if the option --fractal gives it.
int renderer_main(const char* program, const char* fractal, int argc, char** argv);

}  // namespace mandelmarch
