// SPDX-License-Identifier: Apache-2.0
// Prelude for packs of MM_REGISTERS native SIMD registers, written with Google Highway. The registers of a pack are
// independent of each other, so the operations on one register hide the latency of those on another. Before including
// it, define MM_REAL, MM_REAL_IS_FLOAT, MM_FAST (1: fast mode, 0: exact), MM_REGISTERS and MM_COUNTED (1: counts work,
// 0: does not). Include it inside a namespace in HWY_NAMESPACE and before the kernel source.

#if !defined(MM_REAL) || !defined(MM_REAL_IS_FLOAT) || !defined(MM_FAST) || !defined(MM_REGISTERS) || \
    !defined(MM_COUNTED)
#error "expected definitions of MM_REAL, MM_REAL_IS_FLOAT, MM_FAST, MM_REGISTERS and MM_COUNTED"
#endif

namespace hn = hwy::HWY_NAMESPACE;

// Passes the scene by reference, to avoid a copy in each call of an estimator.
#define MM_SCENE_BY_REFERENCE
// With clang, inlining is not forced. clang then simplifies functions before it inlines them, and compiles in one half
// (clang 14) to one eighth (clang 19) of the time. cmake/Kernels.cmake sets an inlining threshold with which the
// same calls are inlined.
#ifdef __clang__
#define FN static inline HWY_MAYBE_UNUSED
#else
#define FN HWY_API
#endif
#define FN_CALLED HWY_NOINLINE HWY_MAYBE_UNUSED
#if MM_REGISTERS == 1
#define FN_SAMPLED FN_CALLED
#else
#define FN_SAMPLED FN
#endif
// EACH_REGISTER(statements) executes the statements for each register u of a pack. It is unrolled by hand: with
// constant indices the compiler keeps every SIMD vector of a pack in a machine register, not in memory.
#define MM_IN_REGISTER(number, ...) \
    {                               \
        constexpr int u = number;   \
        __VA_ARGS__                 \
    }
#if MM_REGISTERS == 1
#define EACH_REGISTER(...) MM_IN_REGISTER(0, __VA_ARGS__)
#elif MM_REGISTERS == 2
#define EACH_REGISTER(...) MM_IN_REGISTER(0, __VA_ARGS__) MM_IN_REGISTER(1, __VA_ARGS__)
#elif MM_REGISTERS == 3
#define EACH_REGISTER(...) MM_IN_REGISTER(0, __VA_ARGS__) MM_IN_REGISTER(1, __VA_ARGS__) MM_IN_REGISTER(2, __VA_ARGS__)
#elif MM_REGISTERS == 4
#define EACH_REGISTER(...)         \
    MM_IN_REGISTER(0, __VA_ARGS__) \
    MM_IN_REGISTER(1, __VA_ARGS__) MM_IN_REGISTER(2, __VA_ARGS__) MM_IN_REGISTER(3, __VA_ARGS__)
#endif
#include "core/kernel/prelude/words.h"

using Reals = hn::ScalableTag<scalar>;
using Wholes = hn::RebindToSigned<Reals>;
using Int = hn::TFromD<Wholes>;

constexpr int register_lanes = static_cast<int>(hn::MaxLanes(Reals()));
constexpr int pack_lanes = MM_REGISTERS * register_lanes;

struct mask {
    hn::Mask<Reals> of[MM_REGISTERS];
};

// One integer per lane.
struct whole {
    hn::Vec<Wholes> of[MM_REGISTERS];

    HWY_INLINE whole() = default;
    HWY_INLINE whole(Int value) { EACH_REGISTER(of[u] = hn::Set(Wholes(), value);) }
};

#if MM_COUNTED
using counter = whole;
#else
// An empty counter, for packs that do not count work.
struct counter {
    HWY_INLINE counter() = default;
    HWY_INLINE counter(Int) {}
    HWY_INLINE counter(const whole&) {}
};

FN counter operator+(const counter&, const counter&) { return {}; }
#endif

// One real number per lane.
struct real {
    hn::Vec<Reals> of[MM_REGISTERS];

    HWY_INLINE real() = default;
    HWY_INLINE real(scalar value) { EACH_REGISTER(of[u] = hn::Set(Reals(), value);) }
};

#define LANEWISE(type, result, name, operation)                   \
    FN result name(const type& a, const type& b)                  \
    {                                                             \
        result c;                                                 \
        EACH_REGISTER(c.of[u] = hn::operation(a.of[u], b.of[u]);) \
        return c;                                                 \
    }
#define LANEWISE_MASK(type, name, operation)                                               \
    FN mask name(const type& a, const type& b)                                             \
    {                                                                                      \
        mask c;                                                                            \
        EACH_REGISTER(c.of[u] = hn::RebindMask(Reals(), hn::operation(a.of[u], b.of[u]));) \
        return c;                                                                          \
    }
LANEWISE(real, real, operator+, Add)
LANEWISE(real, real, operator-, Sub)
LANEWISE(real, real, quotient, Div)
LANEWISE_MASK(real, operator<, Lt)
LANEWISE_MASK(real, operator<=, Le)
LANEWISE_MASK(real, operator>, Gt)
LANEWISE_MASK(real, operator>=, Ge)
LANEWISE_MASK(real, operator==, Eq)
LANEWISE(whole, whole, operator+, Add)
LANEWISE_MASK(whole, operator<, Lt)
LANEWISE(mask, mask, operator&&, And)
LANEWISE(mask, mask, operator||, Or)
#if MM_FAST
// A product that is not computed yet. In fast mode, a multiplication is fused with the addition or subtraction of its
// result. The fusion is explicit, because a compiler that may fuse can decide differently for the registers of a pack.
struct factors {
    real a, b;

    HWY_INLINE operator real() const
    {
        real c;
        EACH_REGISTER(c.of[u] = hn::Mul(a.of[u], b.of[u]);)
        return c;
    }
};

FN factors operator*(const real& a, const real& b) { return {a, b}; }

FN real operator+(const factors& p, const real& c)
{
    real d;
    EACH_REGISTER(d.of[u] = hn::MulAdd(p.a.of[u], p.b.of[u], c.of[u]);)
    return d;
}

FN real operator+(const real& c, const factors& p) { return p + c; }

FN real operator+(const factors& p, const factors& q) { return p + real(q); }

FN real operator-(const factors& p, const real& c)
{
    real d;
    EACH_REGISTER(d.of[u] = hn::MulSub(p.a.of[u], p.b.of[u], c.of[u]);)
    return d;
}

FN real operator-(const real& c, const factors& p)
{
    real d;
    EACH_REGISTER(d.of[u] = hn::NegMulAdd(p.a.of[u], p.b.of[u], c.of[u]);)
    return d;
}

FN real operator-(const factors& p, const factors& q) { return p - real(q); }
#else
LANEWISE(real, real, operator*, Mul)
#endif

#undef LANEWISE
#undef LANEWISE_MASK

FN mask operator!(mask a)
{
    EACH_REGISTER(a.of[u] = hn::Not(a.of[u]);)
    return a;
}

FN real operator-(real a)
{
    EACH_REGISTER(a.of[u] = hn::Neg(a.of[u]);)
    return a;
}

FN bool any(const mask& on)
{
#if MM_REGISTERS > 1 && HWY_TARGET <= HWY_AVX3
    // With AVX-512 a single instruction combines two masks and tests the result.
#if MM_REAL_IS_FLOAT
    const auto any_of = [](__mmask16 a, __mmask16 b) HWY_ATTR { return !_kortestz_mask16_u8(a, b); };
#else
    const auto any_of = [](__mmask8 a, __mmask8 b) HWY_ATTR { return !_kortestz_mask8_u8(a, b); };
#endif
    constexpr int last = MM_REGISTERS - 1;
    return any_of(on.of[0].raw, on.of[1].raw) || (last > 1 && any_of(on.of[last - 1].raw, on.of[last].raw));
#else
    hn::Mask<Reals> all = on.of[0];
    EACH_REGISTER(all = hn::Or(all, on.of[u]);)
    return !hn::AllFalse(Reals(), all);
#endif
}

FN real pick(const mask& on, const real& a, const real& b)
{
    real c;
    EACH_REGISTER(c.of[u] = hn::IfThenElse(on.of[u], a.of[u], b.of[u]);)
    return c;
}

#if HWY_ARCH_X86
// The max and min instructions of x86 return the second operand if an operand is NaN, as the kernel source requires.
#define MM_HAS_LARGER
FN real larger(const real& a, const real& b)
{
    real c;
    EACH_REGISTER(c.of[u] = hn::Max(a.of[u], b.of[u]);)
    return c;
}

FN real smaller(const real& a, const real& b)
{
    real c;
    EACH_REGISTER(c.of[u] = hn::Min(a.of[u], b.of[u]);)
    return c;
}
#endif

// Returns 1 for active lanes and 0 for inactive ones.
FN whole count(const mask& on)
{
    whole c;
    EACH_REGISTER(c.of[u] = hn::IfThenElseZero(hn::RebindMask(Wholes(), on.of[u]), hn::Set(Wholes(), 1));)
    return c;
}

struct vec3 {
    real x, y, z;
};

FN vec3 make_vec3(const real& x, const real& y, const real& z) { return {x, y, z}; }

#include "core/kernel/prelude/pack_functions.h"
