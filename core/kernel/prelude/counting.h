// SPDX-License-Identifier: Apache-2.0
// Prelude in C++ that counts the operations of one lane: the scalar prelude with another type for `real`. Before
// including it, define MM_REAL, MM_REAL_IS_FLOAT and MM_OPERATIONS, an expression for an object with the counters
// `additions`, `multiplications`, `divisions` and `square_roots`. Include it inside a namespace and before the kernel
// source; undefine.h removes its macros.
//
// An operation is a + b, a - b, a * b, quotient(a, b) or root(a). Its operands are numbers of the lane; one of two
// operands may be a scene parameter instead. Operations on values that are the same in all lanes are not counted, nor
// are comparisons, picks, signs, absolute values, conversions, rounding to integers, exponents and integer arithmetic.
// A multiply-add is two operations.

#define FN inline
namespace plain {
#include "core/kernel/prelude/scalar.h"
}  // namespace plain
using plain::counter;
using plain::mask;
using plain::scalar;
using plain::triple;
using plain::whole;

struct real {
    scalar value;

    real() = default;
    real(scalar v) : value(v) {}
};

#define COUNTED_OPERATION(name, kind, expression) \
    inline real name(real left, real right)       \
    {                                             \
        ++MM_OPERATIONS.kind;                     \
        const scalar a = left.value;              \
        const scalar b = right.value;             \
        return expression;                        \
    }
COUNTED_OPERATION(operator+, additions, a + b)
COUNTED_OPERATION(operator-, additions, a - b)
COUNTED_OPERATION(operator*, multiplications, a* b)
COUNTED_OPERATION(quotient, divisions, a / b)
COUNTED_OPERATION(quick_quotient, divisions, a / b)
#undef COUNTED_OPERATION

inline real root(real a)
{
    ++MM_OPERATIONS.square_roots;
    return plain::root(a.value);
}
inline real quick_root(real a) { return root(a); }

inline real operator-(real a) { return -a.value; }
inline mask operator<(real a, real b) { return a.value < b.value; }
inline mask operator<=(real a, real b) { return a.value <= b.value; }
inline mask operator>(real a, real b) { return a.value > b.value; }
inline mask operator>=(real a, real b) { return a.value >= b.value; }
inline mask operator==(real a, real b) { return a.value == b.value; }

inline real magnitude(real a) { return plain::magnitude(a.value); }
inline real nearest(real a) { return plain::nearest(a.value); }
inline real exponent_of(real a) { return plain::exponent_of(a.value); }
inline real two_to(real n) { return plain::two_to(n.value); }

struct vec3 {
    real x, y, z;
};

inline vec3 make_vec3(real x, real y, real z) { return {x, y, z}; }
