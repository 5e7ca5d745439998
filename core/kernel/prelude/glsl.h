// SPDX-License-Identifier: Apache-2.0
// Prelude in GLSL 460; an invocation processes one pixel. Before including it, define MM_REAL_IS_FLOAT (1 or 0) and
// MM_CORRECTED. 1: float divisions and square roots are corrected by exact residuals; 0: they are the device's own.

#define FN
#define FN_CALLED
#define pick(on, a, b) ((on) ? (a) : (b))
#define any(on) (on)
#define count(on) ((on) ? 1 : 0)
#define whole int
#define counter int
#define mask bool
#define triple vec3

// glslang cannot paste suffixes to literals, so the build writes R(0.3) as BY_PRECISION(0.3lf, 0.3f).
#if MM_REAL_IS_FLOAT
#define BY_PRECISION(in_double, in_float) in_float
#define real float
#define scalar float
#else
#define BY_PRECISION(in_double, in_float) in_double
#define real double
#define scalar double
#define vec3 dvec3
#endif

#if MM_CORRECTED
#include "core/kernel/prelude/glsl_corrected.h"
#else
real quotient(real a, real b) { return a / b; }

real root(real a) { return sqrt(a); }
#endif

real quick_quotient(real a, real b) { return quotient(a, b); }

real quick_root(real a) { return root(a); }

real magnitude(real a) { return abs(a); }

// Returns the nearest integer, ties to even.
real nearest(real a) { return roundEven(a); }

#if MM_REAL_IS_FLOAT
// Returns floor(log2 |a|) of a normal number.
real exponent_of(real a) { return real(((floatBitsToInt(a) >> 23) & 0xff) - 127); }

// Returns 2^n for an integer n in [-126, 127].
real two_to(real n) { return intBitsToFloat((int(n) + 127) << 23); }
#else
// Returns floor(log2 |a|) of a normal number.
real exponent_of(real a) { return real(int((unpackDouble2x32(a).y >> 20) & 0x7ffu) - 1023); }

// Returns 2^n for an integer n in [-1022, 1023].
real two_to(real n) { return packDouble2x32(uvec2(0u, uint(int(n) + 1023) << 20)); }
#endif
