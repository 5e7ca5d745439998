// SPDX-License-Identifier: Apache-2.0
// Prelude: the words of the kernel text in OpenCL C 1.2. The compiler is told MM_REAL_IS_FLOAT (1 or 0), MM_LANES
// (pixels at once: 1, or the length of a vector type), MM_EXACT (1 or 0) and MM_IN_DOUBLE (1: quotients and roots of
// floats are computed in double, for devices whose own are not correctly rounded).

#if MM_EXACT
#pragma OPENCL FP_CONTRACT OFF
#else
#pragma OPENCL FP_CONTRACT ON
#endif
#if !MM_REAL_IS_FLOAT || MM_IN_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif

#define MM_PASTE_(a, b) a##b
#define MM_PASTE(a, b) MM_PASTE_(a, b)
#if MM_LANES == 1
#define MM_VECTOR(type) type
#define MM_CONVERT(type) MM_PASTE(convert_, type)
#else
#define MM_VECTOR(type) MM_PASTE(type, MM_LANES)
#define MM_CONVERT(type) MM_PASTE(convert_, MM_VECTOR(type))
#endif

// Int: as wide as a real, so that comparisons of reals and of whole numbers give the same masks.
#if MM_REAL_IS_FLOAT
typedef float scalar;
typedef MM_VECTOR(float) real;
typedef MM_VECTOR(int) Int;
#define R(x) x##f
#define BY_PRECISION(in_double, in_float) in_float##f
#define MM_AS_INT MM_PASTE(as_, MM_VECTOR(int))
#define MM_AS_REAL MM_PASTE(as_, MM_VECTOR(float))
#define MM_TO_REAL MM_CONVERT(float)
#define MM_TO_INT MM_CONVERT(int)
#define MM_MANTISSA_BITS 23
#define MM_EXPONENT_MASK 0xff
#define MM_EXPONENT_BIAS 127
typedef float4 triple;
#else
typedef double scalar;
typedef MM_VECTOR(double) real;
typedef MM_VECTOR(long) Int;
#define R(x) x
#define BY_PRECISION(in_double, in_float) in_double
#define MM_AS_INT MM_PASTE(as_, MM_VECTOR(long))
#define MM_AS_REAL MM_PASTE(as_, MM_VECTOR(double))
#define MM_TO_REAL MM_CONVERT(double)
#define MM_TO_INT MM_CONVERT(long)
#define MM_MANTISSA_BITS 52
#define MM_EXPONENT_MASK 0x7ff
#define MM_EXPONENT_BIAS 1023
typedef double4 triple;
#endif

#define FN static inline __attribute__((always_inline))
#define FN_CALLED FN

// A mask is bool, or a vector of 0 and -1.
#if MM_LANES == 1
typedef int whole;
typedef int effort;
typedef int scalar_whole;
typedef bool mask;
#define any(on) (on)
#define pick(on, a, b) ((on) ? (a) : (b))
#define count(on) ((on) ? 1 : 0)
#else
typedef Int whole;
typedef Int effort;
typedef Int mask;
#if MM_REAL_IS_FLOAT
typedef int scalar_whole;
#else
typedef long scalar_whole;
#endif

FN real pick(mask on, real a, real b) { return select(b, a, on); }

FN whole count(mask on) { return on & 1; }
#endif

typedef struct Vec3 {
    real x;
    real y;
    real z;
} vec3;

FN vec3 make_vec3(real x, real y, real z)
{
    vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
#define vec3(a, b, c) make_vec3(a, b, c)

#if MM_IN_DOUBLE
#define MM_TO_DOUBLE MM_CONVERT(double)

FN real quotient(real a, real b) { return MM_TO_REAL(MM_TO_DOUBLE(a) / MM_TO_DOUBLE(b)); }

FN real root(real a) { return MM_TO_REAL(sqrt(MM_TO_DOUBLE(a))); }
#else
FN real quotient(real a, real b) { return a / b; }

FN real root(real a) { return sqrt(a); }
#endif

FN real quick_quotient(real a, real b) { return quotient(a, b); }

FN real quick_root(real a) { return root(a); }

FN real magnitude(real a) { return fabs(a); }

// The nearest whole number, ties to even.
FN real nearest(real a) { return rint(a); }

// floor(log2 |a|) of a normal number.
FN real exponent_of(real a)
{
    return MM_TO_REAL(((MM_AS_INT(a) >> MM_MANTISSA_BITS) & MM_EXPONENT_MASK) - MM_EXPONENT_BIAS);
}

// 2^n of a whole number n of the normal range.
FN real two_to(real n) { return MM_AS_REAL((MM_TO_INT(n) + MM_EXPONENT_BIAS) << MM_MANTISSA_BITS); }
