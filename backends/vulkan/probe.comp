// SPDX-License-Identifier: Apache-2.0
// The words quotient and root by themselves: the host compares them with IEEE's results.
#version 460
#include "core/kernel/prelude/glsl.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Dividends { real dividends[]; };
layout(std430, binding = 1) readonly buffer Divisors { real divisors[]; };
layout(std430, binding = 2) writeonly buffer Quotients { real quotients[]; };
layout(std430, binding = 3) writeonly buffer Roots { real roots[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    quotients[i] = quotient(dividends[i], divisors[i]);
    roots[i] = root(dividends[i]);
}
