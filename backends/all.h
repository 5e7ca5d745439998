// SPDX-License-Identifier: Apache-2.0
// The registry of all backends, built or not.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch {

// Returns all backends, with their drivers in this process.
Registry all_backends();

// Returns the backends of a program with these arguments. Call it before the program has threads. Each device's driver
// runs in a separate process (core/isolation/isolated.h), unless the argument --no-isolation or
// MANDELMARCH_ISOLATION=off is given; profilers and debuggers can then see a device's kernels in the program.
// MANDELMARCH_BACKENDS lists the backends whose drivers may be opened, separated by commas. Throws InputError for
// invalid values of these variables.
Registry program_backends(int argc, char** argv);

}  // namespace mandelmarch
