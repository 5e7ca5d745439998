// SPDX-License-Identifier: Apache-2.0
#include "apps/renderer_app.h"
#include "backends/all.h"
#include "core/base/error.h"

int mandelbox_main(int argc, char** argv)
{
    const auto body = [](int count, char** values) {
        return mandelmarch::render_program(mandelmarch::program_backends(count, values), "mandelbox", "mandelbox",
                                           count, values);
    };
    return mandelmarch::run_program("mandelbox", body, argc, argv);
}
