// SPDX-License-Identifier: Apache-2.0
// Adds to the scalar prelude what CUDA and HIP need. FN declares functions that run on the device, KERNEL declares
// kernels, ARGUMENT their argument, and SHARED a variable of a block. A Lanes is a set of a warp's lanes; all lanes of
// a warp call ballot() and warp_barrier() together. ballot() returns the lanes for which `on` is true, lanes_of() their
// number, and rank() the number of those before this lane. thread_index() returns a thread's index in the launch.
// take() increments a number in memory as an atomic operation, and returns the number before. reciprocal(),
// inverse_root() and binary_log() are approximate instructions; in double, the errors of the first two are about 2^-20.
#pragma once

#ifdef __HIP__
#include "backends/cuda/amd_words.h"
#elif !defined(KERNEL)  // A test defines the words for the host.
#include "backends/cuda/nvidia_words.h"
#endif

namespace {

#ifdef MM_MODE_fast
#define MM_HAS_QUICK
#define MM_HAS_INVERSE_ROOT
#define MM_HAS_ROUGH
#define MM_HAS_ROUGH_LOG

#if MM_REAL_IS_FLOAT
// Words of fast mode in float, by the approximations that a GPU has as instructions. Their errors are at most two units
// in the last place.
FN float quick_quotient(float a, float b) { return a * reciprocal(b); }

FN float quick_root(float a) { return a * inverse_root(a); }

FN float scaled_inverse_root(float a, float s) { return s * inverse_root(a); }

FN float rough_quotient(float a, float b) { return quick_quotient(a, b); }

FN float rough_root(float a) { return quick_root(a); }

FN float over_root(float a, float, float b) { return a * inverse_root(b); }

// Returns ln a, with an error of 2^-22, absolute near a = 1 and relative elsewhere.
FN float rough_log(float a) { return binary_log(a) * 0.693147181F; }

#define MM_HAS_LARGER
// One instruction each. They return the other operand if one is NaN.
FN float larger(float a, float b) { return __builtin_fmaxf(a, b); }

FN float smaller(float a, float b) { return __builtin_fminf(a, b); }
#else
// Words of fast mode in double. A step of third order triples the bits of an approximation, and a Newton step doubles
// them: quick words have errors of a few units in the last place, rough words have about 2^-40.
FN double quick_reciprocal(double a)
{
    const double y = reciprocal(a);
    const double e = __builtin_fma(-a, y, 1.0);
    return __builtin_fma(y, __builtin_fma(e, e, e), y);
}

FN double scaled_inverse_root(double a, double s)
{
    const double y = inverse_root(a);
    const double e = __builtin_fma(-(a * y), y, 1.0);
    return s * __builtin_fma(__builtin_fma(0.375, e, 0.5), y * e, y);
}

FN double quick_quotient(double a, double b) { return a * quick_reciprocal(b); }

FN double quick_root(double a) { return a * scaled_inverse_root(a, 1); }

FN double rough_quotient(double a, double b)
{
    const double y = reciprocal(b);
    return a * __builtin_fma(y, __builtin_fma(-b, y, 1.0), y);
}

FN double rough_root(double a)
{
    const double y = inverse_root(a);
    return a * __builtin_fma(0.5 * y, __builtin_fma(-(a * y), y, 1.0), y);
}

FN double over_root(double a, double, double b) { return scaled_inverse_root(b, a); }

// Returns ln a, as in float, from the exponent of a and the binary logarithm of its mantissa.
FN double rough_log(double a)
{
    const unsigned long long bits = __builtin_bit_cast(unsigned long long, a);
    const float mantissa = __builtin_bit_cast(float, (unsigned(bits >> 29) & 0x7fffffU) | 0x3f800000U);
    return (float(int(bits >> 52) - 1023) + binary_log(mantissa)) * 0.693147181F;
}
#endif
#endif

}  // namespace
#define MM_ANEW(value)
#define MM_TAKE(number) take(number)
