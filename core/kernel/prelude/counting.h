// SPDX-License-Identifier: Apache-2.0
// Prelude in C++ that counts the operations of one lane. Before including it, define MM_REAL, MM_REAL_IS_FLOAT and
// MM_OPERATIONS, an expression for an object with the counters `additions`, `multiplications`, `divisions` and
// `square_roots`. Include it inside a namespace and before the kernel source; undefine.h removes its macros.
//
// An operation is a + b, a - b, a * b, quotient(a, b) or root(a), of numbers of the lane or of one such number and a
// scene parameter. Operations on values that are the same in all lanes are not counted, nor are comparisons, picks,
// signs, absolute values, conversions, rounding to integers, exponents and integer arithmetic. A multiply-add is two
// operations.

#define FN inline
#define FN_CALLED inline
#define vec3(a, b, c) make_vec3(a, b, c)
#define pick(on, a, b) ((on) ? (a) : (b))
#define any(on) (on)
#define count(on) ((on) ? 1 : 0)
#define R(x) MM_REAL(x)
#if MM_REAL_IS_FLOAT
#define BY_PRECISION(in_double, in_float) MM_REAL(in_float)
#else
#define BY_PRECISION(in_double, in_float) MM_REAL(in_double)
#endif

typedef MM_REAL scalar;
typedef int whole;
typedef int counter;
typedef bool mask;

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

inline real operator-(real a) { return -a.value; }
inline mask operator<(real a, real b) { return a.value < b.value; }
inline mask operator<=(real a, real b) { return a.value <= b.value; }
inline mask operator>(real a, real b) { return a.value > b.value; }
inline mask operator>=(real a, real b) { return a.value >= b.value; }
inline mask operator==(real a, real b) { return a.value == b.value; }

struct vec3 {
    real x, y, z;
};

struct alignas(4 * sizeof(scalar)) triple {
    scalar x, y, z;
};

inline vec3 make_vec3(real x, real y, real z) { return {x, y, z}; }

#if MM_REAL_IS_FLOAT
inline real root(real a)
{
    ++MM_OPERATIONS.square_roots;
    return __builtin_sqrtf(a.value);
}
inline real magnitude(real a) { return __builtin_fabsf(a.value); }
inline real nearest(real a) { return __builtin_rintf(a.value); }
inline real exponent_of(real a)
{
    return static_cast<float>((__builtin_bit_cast(unsigned, a.value) >> 23) & 0xff) - 127.0F;
}
inline real two_to(real n) { return __builtin_bit_cast(float, (static_cast<int>(n.value) + 127) << 23); }
#else
inline real root(real a)
{
    ++MM_OPERATIONS.square_roots;
    return __builtin_sqrt(a.value);
}
inline real magnitude(real a) { return __builtin_fabs(a.value); }
inline real nearest(real a) { return __builtin_rint(a.value); }
inline real exponent_of(real a)
{
    return static_cast<double>((__builtin_bit_cast(unsigned long long, a.value) >> 52) & 0x7ff) - 1023.0;
}
inline real two_to(real n) { return __builtin_bit_cast(double, (static_cast<long long>(n.value) + 1023) << 52); }
#endif

inline real quick_root(real a) { return root(a); }
