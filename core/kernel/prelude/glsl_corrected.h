// SPDX-License-Identifier: Apache-2.0
// The words quotient and root in float where the device's own are some units off in the last place: corrected by their
// exact residuals, with sums and products of floats alone. Needs a device that neither fuses nor reorders them.
//
// A first value that is k units off becomes one that is less than one unit off, by a step of Newton's. Its residual is
// a float (Boldo and Daumas, "Representable correcting terms for possibly underflowing floating point operations",
// 2003), got from the product's exact low part (Dekker, "A floating-point technique for extending the available
// precision", 1971). It tells which neighbour is the nearest: no quotient and no root lies in the middle of two floats.
// Numbers that are subnormal, 0 or not finite, and results beyond normal ones, are the device's.

// The bits of a positive normal number with the exponent of 1.
float mantissa_of(int bits) { return intBitsToFloat((bits & 0x7fffff) | 0x3f800000); }

// a * b = the rounded product + what this returns, for factors in [0.25, 4].
float low_part(float a, float b, float product)
{
    float split_a = 4097.0f * a;
    float high_a = split_a - (split_a - a);
    float rest_a = a - high_a;
    float split_b = 4097.0f * b;
    float high_b = split_b - (split_b - b);
    float rest_b = b - high_b;
    return rest_a * rest_b - (((product - high_a * high_b) - rest_a * high_b) - high_a * rest_b);
}

// a - b * c, where the product is close to a.
float residual(float a, float b, float c)
{
    float product = b * c;
    return (a - product) - low_part(b, c, product);
}

bool is_ordinary(int bits)
{
    int exponent = (bits >> 23) & 0xff;
    return exponent > 0 && exponent < 255;
}

real quotient(real a, real b)
{
    int a_bits = floatBitsToInt(a);
    int b_bits = floatBitsToInt(b);
    int exponent = ((a_bits >> 23) & 0xff) - ((b_bits >> 23) & 0xff);
    if (!is_ordinary(a_bits) || !is_ordinary(b_bits) || abs(exponent) > 120) return a / b;
    float x = mantissa_of(a_bits);
    float y = mantissa_of(b_bits);
    float q = x / y;
    q += residual(x, q, y) / y;
    float left = residual(x, q, y);
    float next = intBitsToFloat(floatBitsToInt(q) + (left > 0.0f ? 1 : -1));
    if (abs(next - q) * y < 2.0f * abs(left)) q = next;
    q *= intBitsToFloat((exponent + 127) << 23);
    return ((a_bits ^ b_bits) < 0) ? -q : q;
}

real root(real a)
{
    int bits = floatBitsToInt(a);
    if (a < 0.0f || !is_ordinary(bits)) return sqrt(a);
    int exponent = ((bits >> 23) & 0xff) - 127;
    int even = exponent & ~1;
    float x = exponent == even ? mantissa_of(bits) : 2.0f * mantissa_of(bits);
    float s = sqrt(x);
    s += residual(x, s, s) / (2.0f * s);
    float left = residual(x, s, s);
    float next = intBitsToFloat(floatBitsToInt(s) + (left > 0.0f ? 1 : -1));
    float middle = abs(next - s) * s;  // less the square of half a step, which is finer than residuals are
    if (left > 0.0f ? left > middle : -left >= middle) s = next;
    return s * intBitsToFloat((even / 2 + 127) << 23);
}
