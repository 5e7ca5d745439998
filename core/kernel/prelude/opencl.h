// SPDX-License-Identifier: Apache-2.0
// Prelude in OpenCL C 1.2. Compiler options define MM_REAL_IS_FLOAT (1 or 0); MM_LANES, the number of pixels processed
// at once, which is 1 or the length of a vector type; MM_EXACT (1 or 0); and MM_IN_DOUBLE, which is 1 on devices whose
// float divisions and square roots are not correctly rounded, and are therefore computed in double. MM_NATIVE is 1 if
// the native functions of OpenCL shall be used for approximations; 0 in exact mode, in double, and with several lanes.

#if MM_EXACT
#pragma OPENCL FP_CONTRACT OFF
#else
#pragma OPENCL FP_CONTRACT ON
#endif
#if !MM_REAL_IS_FLOAT || MM_IN_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif

// Defines MM_AVX512 if vectors have one or more registers of AVX-512 and the compiler has the functions for them.
#if defined(__AVX512DQ__) && defined(__has_builtin) && MM_LANES >= (MM_REAL_IS_FLOAT ? 16 : 8)
#if __has_builtin(__builtin_ia32_rcp14ps512_mask) && __has_builtin(__builtin_ia32_rsqrt14pd512_mask) && \
    __has_builtin(__builtin_ia32_cvtd2mask512) && __has_builtin(__builtin_ia32_cvtq2mask512)
#define MM_AVX512
#endif
#endif

#define MM_PASTE_(a, b) a##b
#define MM_PASTE(a, b) MM_PASTE_(a, b)

// MM_INT is as wide as a real, so that comparisons of reals and comparisons of integers give the same type of mask.
#if MM_REAL_IS_FLOAT
#define MM_SCALAR float
#define MM_INT int
#define R(x) x##f
#define BY_PRECISION(in_double, in_float) in_float##f
#define MM_MANTISSA_BITS 23
#define MM_EXPONENT_MASK 0xff
#define MM_EXPONENT_BIAS 127
typedef float4 triple;
#else
#define MM_SCALAR double
#define MM_INT long
#define R(x) x
#define BY_PRECISION(in_double, in_float) in_double
#define MM_MANTISSA_BITS 52
#define MM_EXPONENT_MASK 0x7ff
#define MM_EXPONENT_BIAS 1023
typedef double4 triple;
#endif

typedef MM_SCALAR scalar;
#if MM_LANES > 16
// Vectors of clang, which can be longer than those of OpenCL. Each half is an OpenCL vector.
typedef MM_SCALAR real __attribute__((ext_vector_type(MM_LANES)));
typedef MM_INT Int __attribute__((ext_vector_type(MM_LANES)));
#define MM_AS_INT(x) __builtin_astype(x, Int)
#define MM_AS_REAL(x) __builtin_astype(x, real)
#define MM_TO_INT(x) __builtin_convertvector(x, Int)
#define MM_TO_REAL(x) __builtin_convertvector(x, real)
typedef double Double __attribute__((ext_vector_type(MM_LANES)));
#define MM_TO_DOUBLE(x) __builtin_convertvector(x, Double)
#else
#if MM_LANES == 1
#define MM_VECTOR(type) type
#else
#define MM_VECTOR(type) MM_PASTE(type, MM_LANES)
#endif
typedef MM_VECTOR(MM_SCALAR) real;
typedef MM_VECTOR(MM_INT) Int;
#define MM_AS_INT MM_PASTE(as_, MM_VECTOR(MM_INT))
#define MM_AS_REAL MM_PASTE(as_, MM_VECTOR(MM_SCALAR))
#define MM_TO_INT MM_PASTE(convert_, MM_VECTOR(MM_INT))
#define MM_TO_REAL MM_PASTE(convert_, MM_VECTOR(MM_SCALAR))
typedef MM_VECTOR(double) Double;
#define MM_TO_DOUBLE MM_PASTE(convert_, MM_VECTOR(double))
#endif

#define FN static inline __attribute__((always_inline))
#define FN_CALLED FN

// A mask is a bool, or a vector whose elements are 0 (inactive) or -1 (active).
#if MM_LANES == 1
typedef int whole;
typedef int counter;
typedef int scalar_whole;
typedef bool mask;
#undef any  // some drivers define a macro of this name
#define any(on) (on)
#define pick(on, a, b) ((on) ? (a) : (b))
#define count(on) ((on) ? 1 : 0)
#else
typedef Int whole;
typedef Int counter;
typedef Int mask;
typedef MM_INT scalar_whole;

FN real pick(mask on, real a, real b) { return on ? a : b; }

FN whole count(mask on) { return on & 1; }

// Returns the mask as bits: bit n is set if lane n is active.
FN uint bits_of(mask on)
{
    uint bits = 0;
#if !defined(MM_AVX512)
    union {
        mask all;
        MM_INT of[MM_LANES];
    } lanes = {on};
    for (int lane = 0; lane < MM_LANES; ++lane) bits += (uint)lanes.of[lane] & (1u << lane);
#elif MM_REAL_IS_FLOAT
    union {
        mask all;
        int16 of[MM_LANES / 16];
    } registers = {on};
#pragma unroll
    for (int n = 0; n < MM_LANES / 16; ++n)
        bits |= (uint)(ushort)__builtin_ia32_cvtd2mask512(registers.of[n]) << 16 * n;
#else
    union {
        mask all;
        long8 of[MM_LANES / 8];
    } registers = {on};
#pragma unroll
    for (int n = 0; n < MM_LANES / 8; ++n) bits |= (uint)(uchar)__builtin_ia32_cvtq2mask512(registers.of[n]) << 8 * n;
#endif
    return bits;
}

#undef any
#define any(on) any_lane(on)

#ifdef MM_AVX512
FN bool any_lane(mask on) { return bits_of(on) != 0; }
#else
// Combines the halves of a mask until two lanes are left. This replaces the any() of OpenCL, which some drivers compute
// by testing the lanes one by one.
FN bool any_lane(mask on)
{
#if MM_LANES == 32
    MM_PASTE(MM_INT, 16) sixteen = on.lo | on.hi;
#elif MM_LANES == 16
    mask sixteen = on;
#endif
#if MM_LANES >= 16
    MM_PASTE(MM_INT, 8) eight = sixteen.lo | sixteen.hi;
#elif MM_LANES == 8
    mask eight = on;
#endif
#if MM_LANES >= 8
    MM_PASTE(MM_INT, 4) four = eight.lo | eight.hi;
#elif MM_LANES == 4
    mask four = on;
#endif
#if MM_LANES >= 4
    MM_PASTE(MM_INT, 2) two = four.lo | four.hi;
#else
    mask two = on;
#endif
    return (two.x | two.y) != 0;
}
#endif
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

// Applies a function of OpenCL to a vector, which may be longer than OpenCL's vectors.
#if MM_LANES > 16
#define MM_BY_HALVES(type, function, a) ((type)(function((a).lo), function((a).hi)))
#else
#define MM_BY_HALVES(type, function, a) function(a)
#endif

#if MM_IN_DOUBLE
FN real quotient(real a, real b) { return MM_TO_REAL(MM_TO_DOUBLE(a) / MM_TO_DOUBLE(b)); }

FN real root(real a)
{
    Double wide = MM_TO_DOUBLE(a);
    return MM_TO_REAL(MM_BY_HALVES(Double, sqrt, wide));
}
#else
FN real quotient(real a, real b) { return a / b; }

FN real root(real a) { return MM_BY_HALVES(real, sqrt, a); }
#endif

FN real magnitude(real a) { return MM_BY_HALVES(real, fabs, a); }

// Returns the nearest integer, ties to even.
FN real nearest(real a) { return MM_BY_HALVES(real, rint, a); }

// Returns floor(log2 |a|) of a normal number.
FN real exponent_of(real a)
{
    return MM_TO_REAL(((MM_AS_INT(a) >> MM_MANTISSA_BITS) & MM_EXPONENT_MASK) - MM_EXPONENT_BIAS);
}

// Returns 2^n for an integer n. The result must be a normal number.
FN real two_to(real n) { return MM_AS_REAL((MM_TO_INT(n) + MM_EXPONENT_BIAS) << MM_MANTISSA_BITS); }

#include "core/kernel/prelude/opencl_quick.h"
