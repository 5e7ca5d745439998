// SPDX-License-Identifier: Apache-2.0
// The program `bench`. The backends are a parameter, so that tests can pass broken ones.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch::bench {

// Runs the command line and returns the exit code. Throws InputError, Unavailable and Error, which run_program() turns
// into messages and exit codes.
int bench_program(Registry registry, int argc, char** argv);

}  // namespace mandelmarch::bench
