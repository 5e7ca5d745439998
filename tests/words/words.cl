// SPDX-License-Identifier: Apache-2.0
// The words in OpenCL C: a work item computes all words of a vector of operands.
#include "core/kernel/prelude/opencl.h"
#include "core/kernel/vectors.h"
#include "core/kernel/numbers.h"
#include "tests/words/words.h"

__kernel void answer(__global const real* a, __global const real* b, __global real* out, int words)
{
    size_t i = get_global_id(0);
    for (int word = 0; word < words; ++word) out[word * get_global_size(0) + i] = result_of(word, a[i], b[i]);
}
