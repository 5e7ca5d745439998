// SPDX-License-Identifier: Apache-2.0
// A separate kernel source, which only computes multiply-adds, to measure the peak throughput. Ten independent chains
// hide the latency of a core's two multiply-add units (4 to 5 cycles each). Together with a and b, they fit into the 16
// registers of AVX2. They begin with different values, so that the compiler cannot merge them.

struct Chains {
    real c0;
    real c1;
    real c2;
    real c3;
    real c4;
    real c5;
    real c6;
    real c7;
    real c8;
    real c9;
};

FN Chains multiplied_and_added(Chains c, real a, real b)
{
    c.c0 = c.c0 * a + b;
    c.c1 = c.c1 * a + b;
    c.c2 = c.c2 * a + b;
    c.c3 = c.c3 * a + b;
    c.c4 = c.c4 * a + b;
    c.c5 = c.c5 * a + b;
    c.c6 = c.c6 * a + b;
    c.c7 = c.c7 * a + b;
    c.c8 = c.c8 * a + b;
    c.c9 = c.c9 * a + b;
    return c;
}

// Performs 40 * rounds multiply-adds on every lane (peak_operations_per_round in core/render/peak.h). With a = 0.5 and
// b = 1, every chain converges to 2, and no value is subnormal or infinite.
FN real multiply_add_chains(real x, real a, real b, int rounds)
{
    Chains c;
    c.c0 = x;
    c.c1 = x + 1;
    c.c2 = x + 2;
    c.c3 = x + 3;
    c.c4 = x + 4;
    c.c5 = x + 5;
    c.c6 = x + 6;
    c.c7 = x + 7;
    c.c8 = x + 8;
    c.c9 = x + 9;
    int i = 0;
    while (i < rounds) {
        c = multiplied_and_added(c, a, b);
        c = multiplied_and_added(c, a, b);
        c = multiplied_and_added(c, a, b);
        c = multiplied_and_added(c, a, b);
        i = i + 1;
    }
    return c.c0 + c.c1 + c.c2 + c.c3 + c.c4 + c.c5 + c.c6 + c.c7 + c.c8 + c.c9;
}
