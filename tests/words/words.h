// SPDX-License-Identifier: Apache-2.0
// The results of words of the kernel's language. words_test.cpp has the words' names. Include it after a prelude,
// vectors.h and numbers.h.
FN real result_of(int word, real a, real b)
{
    if (word == 0) return quotient(a, b);
    if (word == 1) return root(a);
    if (word == 2) return magnitude(a);
    if (word == 3) return nearest(a);
    if (word == 4) return exponent_of(a);
    if (word == 5) return two_to(nearest(a));
    if (word == 6) return larger(a, b);
    if (word == 7) return smaller(a, b);
    if (word == 8) return pick(!(a <= b), a, b);
    if (word == 9) return pick(a >= b && a > b, a, b);
    if (word == 10 && any(a < b)) return pick(count(a < b) < 1, b, a);
    if (word == 10) return b;
    if (word == 11) return a * b + a;
    if (word == 12) return clipped(a, R(1.5));
    if (word == 13) return quick_quotient(a, b);
    if (word == 14) return quick_root(a);
    if (word == 15) return over_root(a, quotient(a, b), b);
    if (word == 16) return natural_log(magnitude(a));
    if (word == 17) return exponential(a);
    if (word == 18) return cosine_and_sine(a).re;
    if (word == 19) return cosine_and_sine(a).im;
    return angle_of(a, b);
}
