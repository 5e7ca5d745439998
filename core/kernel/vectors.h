// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 2: vectors. Their operations are written by component, because OpenCL C has no operators for
// structs.

FN real dot3(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

FN real norm(vec3 a) { return root(dot3(a, a)); }

// Returns p + t d.
FN vec3 along(vec3 p, vec3 d, real t) { return vec3(d.x * t + p.x, d.y * t + p.y, d.z * t + p.z); }

FN vec3 minus(vec3 a, vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }

FN vec3 times(real s, vec3 a) { return vec3(s * a.x, s * a.y, s * a.z); }

FN vec3 unit(vec3 a)
{
    real length = quick_root(dot3(a, a));
    return vec3(quick_quotient(a.x, length), quick_quotient(a.y, length), quick_quotient(a.z, length));
}

FN vec3 pick3(mask on, vec3 a, vec3 b) { return vec3(pick(on, a.x, b.x), pick(on, a.y, b.y), pick(on, a.z, b.z)); }

// Copies a triple, which is the same for all lanes, to every lane.
FN vec3 splat(triple a) { return vec3(a.x, a.y, a.z); }

// Functions that return the max or min of a and b; b if one of them is NaN. A prelude can define these functions as
// single instructions. On GPUs, in fast mode and float, they return a if b is NaN. Callers may rely only on a result
// that is not NaN if b is not NaN.
#ifndef MM_HAS_LARGER
FN real larger(real a, real b) { return pick(a > b, a, b); }

FN real smaller(real a, real b) { return pick(a < b, a, b); }
#endif

// Returns x, clamped to [-most, most].
#ifndef MM_HAS_CLIPPED
FN real clipped(real x, scalar most) { return smaller(larger(x, -most), most); }
#endif

// Returns |a|^2, but at least a small number whose square root has a finite reciprocal.
FN real norm2(vec3 a) { return larger(dot3(a, a), BY_PRECISION(1.0e-290, 1.0e-30)); }

FN real quick_norm(vec3 a) { return quick_root(norm2(a)); }

// Rough functions have an accuracy of at least 14 bits. They are used for factors of an estimate, never for the
// position of a point.
#ifndef MM_HAS_ROUGH
FN real rough_quotient(real a, real b) { return quick_quotient(a, b); }

FN real rough_root(real a) { return quick_root(a); }

// Returns a / sqrt(b). `less` must be a / b. A prelude with a fast 1 / sqrt(b) can define over_root() with one
// multiplication less.
#define over_root(a, less, b) ((less)*quick_root(b))
#endif

#ifndef MM_HAS_INVERSE_ROOT
// Returns s / sqrt(a).
FN real scaled_inverse_root(real a, scalar s) { return quick_quotient(s, quick_root(a)); }
#endif

#ifndef MM_HAS_TALLY
// Adds 1 to the work count of each active lane.
FN counter tally(counter a, mask on) { return a + count(on); }
#endif

struct Complex {
    real re;
    real im;
};

FN Complex complex_number(real re, real im)
{
    Complex c;
    c.re = re;
    c.im = im;
    return c;
}

FN Complex product(Complex a, Complex b)
{
    return complex_number(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}

FN Complex squared(Complex a)
{
    real twice = a.re + a.re;
    return complex_number(a.re * a.re - a.im * a.im, twice * a.im);
}

// Returns a^2. length2 must be |a|^2; it saves a multiplication, because re^2 - im^2 = 2 re^2 - |a|^2.
FN Complex squared_within(Complex a, real length2)
{
    real twice = a.re + a.re;
    return complex_number(twice * a.re - length2, twice * a.im);
}

// raised() computes a^n by left-to-right binary powers (Knuth, The Art of Computer Programming 2, 4.6.3), for
// 1 <= n < 1024. It is unrolled, with one call per bit of n, because some drivers limit the loop iterations of an
// invocation. If n is a compile-time constant, only the necessary multiplications remain.
FN Complex raised_by_bit(Complex result, Complex a, int n, int bit)
{
    if (n / bit > 1) {
        result = squared(result);
        if ((n & bit) != 0) result = product(result, a);
    }
    return result;
}

// Returns a^n. n >= 1.
FN Complex raised(Complex a, int n)
{
    Complex result = raised_by_bit(a, a, n, 256);
    result = raised_by_bit(result, a, n, 128);
    result = raised_by_bit(result, a, n, 64);
    result = raised_by_bit(result, a, n, 32);
    result = raised_by_bit(result, a, n, 16);
    result = raised_by_bit(result, a, n, 8);
    result = raised_by_bit(result, a, n, 4);
    result = raised_by_bit(result, a, n, 2);
    return raised_by_bit(result, a, n, 1);
}

FN real raised_real_by_bit(real result, real a, int n, int bit)
{
    if (n / bit > 1) {
        result = result * result;
        if ((n & bit) != 0) result = result * a;
    }
    return result;
}

// Returns a^n. n >= 0.
FN real raised_real(real a, int n)
{
    real result = a;
    if (n == 0) result = 1;
    result = raised_real_by_bit(result, a, n, 256);
    result = raised_real_by_bit(result, a, n, 128);
    result = raised_real_by_bit(result, a, n, 64);
    result = raised_real_by_bit(result, a, n, 32);
    result = raised_real_by_bit(result, a, n, 16);
    result = raised_real_by_bit(result, a, n, 8);
    result = raised_real_by_bit(result, a, n, 4);
    result = raised_real_by_bit(result, a, n, 2);
    return raised_real_by_bit(result, a, n, 1);
}
