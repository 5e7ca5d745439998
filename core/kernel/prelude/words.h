// SPDX-License-Identifier: Apache-2.0
// Definitions that all preludes in C++ include, because they are the same in each.

#if !defined(MM_REAL) || !defined(MM_REAL_IS_FLOAT)
#error "expected definitions of MM_REAL and MM_REAL_IS_FLOAT"
#endif

#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "this compiler computes in a higher precision than the type's; on x86, give it -msse2 -mfpmath=sse"
#endif

#define vec3(a, b, c) make_vec3(a, b, c)
#define R(x) MM_REAL(x)
#if MM_REAL_IS_FLOAT
#define BY_PRECISION(in_double, in_float) MM_REAL(in_float)
#else
#define BY_PRECISION(in_double, in_float) MM_REAL(in_double)
#endif

typedef MM_REAL scalar;

struct alignas(4 * sizeof(scalar)) triple {
    scalar x, y, z;
};
