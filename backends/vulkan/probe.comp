// SPDX-License-Identifier: Apache-2.0
// Computes quotients, square roots and sums of products. The host compares them with IEEE 754's results, to check the
// assumptions of exact mode. A device that fuses a multiplication with an addition rounds once instead of twice, which
// changes these sums.
#version 460
#include "core/kernel/prelude/glsl.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Dividends { real dividends[]; };
layout(std430, binding = 1) readonly buffer Divisors { real divisors[]; };
layout(std430, binding = 2) readonly buffer Addends { real addends[]; };
layout(std430, binding = 3) writeonly buffer Quotients { real quotients[]; };
layout(std430, binding = 4) writeonly buffer Roots { real roots[]; };
layout(std430, binding = 5) writeonly buffer Sums { real sums[]; };

real multiplied_and_added(real a, real b, real c) { return a * b + c; }

// A chain of multiplications and additions in a called function, such as a norm.
real norm(vec3 v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

void main()
{
    uint i = gl_GlobalInvocationID.x;
    real a = dividends[i];
    real b = divisors[i];
    real c = addends[i];
    quotients[i] = quotient(a, b);
    roots[i] = root(a);
    uint count = addends.length();
    sums[i] = a * b + c;
    sums[count + i] = c - a * b;
    sums[2 * count + i] = multiplied_and_added(b, a, c);
    sums[3 * count + i] = norm(vec3(a, b, c));
    sums[4 * count + i] = ((a * b + c) * a + b) * c + a;
}
