// SPDX-License-Identifier: Apache-2.0
// Stack size of OpenMP's threads.
#pragma once

namespace mandelmarch::openmp {

// Throws InputError if OMP_STACKSIZE or GOMP_STACKSIZE sets the stacks too small for packs of rays. The threads would
// crash.
void check_stack_size();

}  // namespace mandelmarch::openmp
