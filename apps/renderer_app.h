// SPDX-License-Identifier: Apache-2.0
// The program behind mandelbulb, mandelbox and render.
#pragma once

#include "backends/all.h"
#include "core/text/error.h"
#include "core/os/program.h"

namespace mandelmarch {

// Runs the program with these backends. `fractal`: the fractal's name; nullptr if the option --fractal gives it.
int render_program(const Registry& registry, const char* program, const char* fractal, int argc, char** argv);

// The main function of these programs. It is inline, so that each program links the backends that it lists.
inline int renderer_main(const char* program, const char* fractal, int argc, char** argv)
{
    const auto body = [&](int count, char** values) {
        return render_program(program_backends(count, values), program, fractal, count, values);
    };
    return run_program(program, body, argc, argv);
}

}  // namespace mandelmarch
