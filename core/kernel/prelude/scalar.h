// SPDX-License-Identifier: Apache-2.0
// Prelude in scalar C++. Before including it, define MM_REAL (float or double) and MM_REAL_IS_FLOAT (1 or 0). Include
// it inside a namespace and before the kernel source; undefine.h removes its macros. Who defines MM_HAS_QUICK defines
// quick_quotient() and quick_root(), too.
#include "core/kernel/prelude/words.h"

#ifndef FN
#define FN __attribute__((always_inline)) inline
#endif
#ifndef FN_CALLED
#define FN_CALLED FN
#endif
#define pick(on, a, b) ((on) ? (a) : (b))
#define any(on) (on)
#define count(on) ((on) ? 1 : 0)

// nearbyint and rint both round to the nearest integer, ties to even. nvptx has an instruction for nearbyint, and x86
// computes rint with a few instructions. If the two functions were exchanged, each would be a call of a library.
#if defined(_OPENACC) || defined(MM_OFFLOADED)
#define MM_NEAREST(suffix) __builtin_nearbyint##suffix
#else
#define MM_NEAREST(suffix) __builtin_rint##suffix
#endif

typedef MM_REAL real;
typedef int whole;
typedef int counter;
typedef bool mask;

struct vec3 {
    real x, y, z;
};

FN vec3 make_vec3(real x, real y, real z) { return {x, y, z}; }

FN real quotient(real a, real b) { return a / b; }

#if MM_REAL_IS_FLOAT
FN real root(real a) { return __builtin_sqrtf(a); }

FN real magnitude(real a) { return __builtin_fabsf(a); }

FN real nearest(real a) { return MM_NEAREST(f)(a); }

// Returns floor(log2 |a|) of a normal number.
FN real exponent_of(real a) { return real((__builtin_bit_cast(unsigned, a) >> 23) & 0xff) - 127.0F; }

// Returns 2^n for an integer n in [-126, 127].
FN real two_to(real n) { return __builtin_bit_cast(real, (int(n) + 127) << 23); }
#else
FN real root(real a) { return __builtin_sqrt(a); }

FN real magnitude(real a) { return __builtin_fabs(a); }

FN real nearest(real a) { return MM_NEAREST()(a); }

// Returns floor(log2 |a|) of a normal number.
FN real exponent_of(real a) { return real((__builtin_bit_cast(unsigned long long, a) >> 52) & 0x7ff) - 1023.0; }

// Returns 2^n for an integer n in [-1022, 1023].
FN real two_to(real n) { return __builtin_bit_cast(real, ((long long)(n) + 1023) << 52); }
#endif

#ifndef MM_HAS_QUICK
FN real quick_quotient(real a, real b) { return a / b; }

FN real quick_root(real a) { return root(a); }
#endif
