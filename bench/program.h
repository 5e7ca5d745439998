// SPDX-License-Identifier: Apache-2.0
// The program `bench`, on whatever backends it is given: tests give it broken ones.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch::bench {

// Runs the command line and returns the exit code; throws InputError, Unavailable and Error as run_program expects
// them.
int bench_program(const Registry& registry, int argc, char** argv);

}  // namespace mandelmarch::bench
