// SPDX-License-Identifier: Apache-2.0
// Prelude in C++ that counts loop iterations. Real numbers have no values and all lanes stay active, so every loop runs
// to its limit. Only values that are the same in all lanes are computed; their type is MM_REAL. Before including it,
// define MM_REAL, MM_REAL_IS_FLOAT and MM_LOOPS, an expression for the counter. Include it inside a namespace and
// before the kernel source; undefine.h removes its macros.
#include "core/kernel/prelude/counted_loops.h"
#include "core/kernel/prelude/words.h"

#define FN inline
#define FN_CALLED inline

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

inline vec3 make_vec3(real x, real y, real z) { return {x, y, z}; }

inline real quotient(real, real) { return {}; }
inline real quick_quotient(real, real) { return {}; }
inline real root(real) { return {}; }
inline real quick_root(real) { return {}; }
inline real magnitude(real) { return {}; }
inline real nearest(real) { return {}; }
inline real exponent_of(real) { return {}; }
inline real two_to(real) { return {}; }
