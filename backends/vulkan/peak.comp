// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak: every invocation runs the chains of core/kernel/peak.h.
#version 460
#include "core/kernel/prelude/glsl.h"
#include "core/kernel/peak.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer Sums { real sums[]; };
// The factor and the addend of the chains; in a buffer, so that they are not compile-time constants.
layout(std430, binding = 1) readonly buffer Given { real given[]; };

layout(push_constant) uniform Pass { int rounds; } pass;

// Each invocation begins with a different value and stores its result, so that the compiler cannot remove the chains.
void main()
{
    int i = int(gl_GlobalInvocationID.x);
    sums[i] = multiply_add_chains(real(i) * BY_PRECISION(1.0e-6lf, 1.0e-6f), given[0], given[1], pass.rounds);
}
