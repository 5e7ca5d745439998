// SPDX-License-Identifier: Apache-2.0
// Correctly rounded float division and square root, for devices whose own are some ulp off. Corrects the device's
// results by exact residuals, with additions and multiplications of floats only. The device must neither fuse nor
// reorder these.
//
// The device's result may be k ulp off; a Newton step reduces the error to less than one ulp. The residual of that
// result is a float (Boldo and Daumas, "Representable correcting terms for possibly underflowing floating point
// operations", 2003). It is computed from the exact low part of the product (Dekker, "A floating-point technique for
// extending the available precision", 1971). The residual shows which of two adjacent floats is nearest, because no
// quotient or square root lies midway between two floats. If an operand is subnormal, 0 or not finite, or the result is
// not normal, the device's result is returned.

// Returns the mantissa of a normal number, as a float from 1 to below 2.
float mantissa_of(int bits) { return intBitsToFloat((bits & 0x7fffff) | 0x3f800000); }

// Returns the rounding error of a product: a * b = product + result. The factors must be in [0.25, 4].
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

// Returns a - b * c exactly. The product must be close to a.
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
    float middle = abs(next - s) * s;  // omits the squared half step, which is smaller than any residual
    if (left > 0.0f ? left > middle : -left >= middle) s = next;
    return s * intBitsToFloat((even / 2 + 127) << 23);
}
