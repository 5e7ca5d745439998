// SPDX-License-Identifier: Apache-2.0
// The registry of all backends, built or not.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch {

// Two backends that every build has.
std::unique_ptr<Backend> make_openmp_backend();
std::unique_ptr<Backend> make_reference_backend();

// Returns all backends, with their drivers in this process.
Registry all_backends();

// Returns the backends of a program with these arguments. Must be called before the program starts threads. By default
// each device's driver runs in a separate process (core/isolation/isolated.h). With the argument --no-isolation or the
// environment variable MANDELMARCH_ISOLATION=off, drivers run in the program's own process, where profilers and
// debuggers can observe them. MANDELMARCH_BACKENDS lists the backends whose drivers may be opened, separated by commas.
// Throws InputError if one of these variables, or OMP_NUM_THREADS, has an invalid value. Throws Error if all_backends()
// was called before and drivers are to run in separate processes, because a driver that is open in this process hangs
// in a process that is forked from it.
Registry program_backends(int argc, char** argv);

}  // namespace mandelmarch
