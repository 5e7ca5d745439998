// SPDX-License-Identifier: Apache-2.0
#include "apps/renderer_app.h"
#include "backends/all.h"

int mandelbulb_main(int argc, char** argv)
{
    return mandelmarch::renderer_main("mandelbulb", "mandelbulb", mandelmarch::program_backends, argc, argv);
}
