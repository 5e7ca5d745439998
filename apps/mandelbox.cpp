// SPDX-License-Identifier: Apache-2.0
#include "apps/renderer_app.h"
#include "backends/all.h"

int mandelbox_main(int argc, char** argv)
{
    return mandelmarch::renderer_main("mandelbox", "mandelbox", mandelmarch::program_backends, argc, argv);
}
