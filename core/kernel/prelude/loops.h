// SPDX-License-Identifier: Apache-2.0
// Prelude in C++ that counts loop iterations. Real numbers have no values and all lanes stay active, so every loop runs
// to its limit. Values that are the same in all lanes are computed, in double. Before including it, define MM_LOOPS, an
// expression for the counter, and MM_REAL_IS_FLOAT as 0. Include it inside a namespace and before the kernel source;
// undefine.h removes its macros.
#include "core/kernel/prelude/counted_loops.h"

#define FN inline
#define FN_CALLED inline
#define vec3(a, b, c) make_vec3(a, b, c)
#define R(x) double(x)
#define BY_PRECISION(in_double, in_float) double(in_double)

typedef double scalar;

struct real {
    real() = default;
    real(double) {}
};
typedef real whole;
typedef real counter;

struct mask {
    mask() = default;
    mask(bool) {}
};

inline real operator+(real, real) { return {}; }
inline real operator-(real, real) { return {}; }
inline real operator*(real, real) { return {}; }
inline real operator-(real) { return {}; }
inline mask operator<(real, real) { return {}; }
inline mask operator<=(real, real) { return {}; }
inline mask operator>(real, real) { return {}; }
inline mask operator>=(real, real) { return {}; }
inline mask operator==(real, real) { return {}; }
inline mask operator&&(mask, mask) { return {}; }
inline mask operator||(mask, mask) { return {}; }
inline mask operator!(mask) { return {}; }

inline bool any(mask) { return true; }
inline real count(mask) { return {}; }
inline real pick(mask, real, real) { return {}; }

struct vec3 {
    real x, y, z;
};

struct alignas(4 * sizeof(scalar)) triple {
    scalar x, y, z;
};

inline vec3 make_vec3(real x, real y, real z) { return {x, y, z}; }

inline real quotient(real, real) { return {}; }
inline real quick_quotient(real, real) { return {}; }
inline real root(real) { return {}; }
inline real quick_root(real) { return {}; }
inline real magnitude(real) { return {}; }
inline real nearest(real) { return {}; }
inline real exponent_of(real) { return {}; }
inline real two_to(real) { return {}; }
