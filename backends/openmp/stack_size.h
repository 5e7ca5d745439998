// SPDX-License-Identifier: Apache-2.0
// The stacks of OpenMP's threads.
#pragma once

namespace mandelmarch::openmp {

// Throws InputError where OMP_STACKSIZE or GOMP_STACKSIZE asks for stacks on which packs of rays have no room: threads
// would crash.
void check_stack_size();

}  // namespace mandelmarch::openmp
