// SPDX-License-Identifier: Apache-2.0
#include "apps/renderer_app.h"

int render_main(int argc, char** argv) { return mandelmarch::renderer_main("render", nullptr, argc, argv); }
