// SPDX-License-Identifier: Apache-2.0
// The plan that flythrough's options describe.
#pragma once

#include "apps/flythrough_options.h"
#include "flight/ride/planner.h"

namespace mandelmarch {

// Prints warnings about the parameter file. Throws InputError if the fractal cannot be flown through, or if an input
// file is invalid.
void check_plan(const Flythrough& options);

// Plans the flight, with the number of frames and the frame rate of the options. Prints progress to stderr.
Plan make_plan(const Flythrough& options);

}  // namespace mandelmarch
