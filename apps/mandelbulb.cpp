// SPDX-License-Identifier: Apache-2.0
#include "apps/renderer_app.h"
#include "core/base/error.h"

int main(int argc, char** argv)
{
    const auto body = [](int count, char** values) {
        return mandelmarch::render_program("mandelbulb", "mandelbulb", count, values);
    };
    return mandelmarch::run_program("mandelbulb", body, argc, argv);
}
