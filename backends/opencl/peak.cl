// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak: every work item runs the chains of core/kernel/peak.h on MM_LANES lanes.
#include "core/kernel/prelude/opencl.h"
#include "core/kernel/peak.h"

union Reals {
    real all;
    scalar of[MM_LANES];
};

// Each item begins with a different value and stores its result, so that the compiler cannot remove the chains.
__kernel void multiply_adds(__global scalar* sums, scalar a, scalar b, int rounds)
{
    real x = (real)((scalar)get_global_id(0)) * R(1.0e-6);
    union Reals sum;
    sum.all = multiply_add_chains(x, (real)(a), (real)(b), rounds);
    sums[get_global_id(0)] = sum.of[0];
}
