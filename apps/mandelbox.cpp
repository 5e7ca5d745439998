// SPDX-License-Identifier: Apache-2.0
#include "apps/renderer_app.h"

int mandelbox_main(int argc, char** argv) { return mandelmarch::renderer_main("mandelbox", "mandelbox", argc, argv); }
