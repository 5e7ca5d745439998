// Prelude: the words of the kernel text as packs of MM_REGISTERS native SIMD registers, on Google Highway. Registers of
// one pack do not depend on each other and hide each other's latency. Define MM_REAL, MM_REAL_IS_FLOAT, MM_REGISTERS
// and include it inside a namespace in HWY_NAMESPACE, before the text.

namespace hn = hwy::HWY_NAMESPACE;

// A copy of the scene for every call of an estimator is worth avoiding.
#define MM_SCENE_BY_REFERENCE
#define FN HWY_API
#define FN_CALLED HWY_NOINLINE HWY_MAYBE_UNUSED
// Written out, not a loop: with constant indices the compiler keeps every register of a pack in a register.
#if MM_REGISTERS == 1
#define EACH_REGISTER(...)   \
    {                        \
        constexpr int u = 0; \
        __VA_ARGS__          \
    }
#elif MM_REGISTERS == 4
#define EACH_REGISTER(...)   \
    {                        \
        constexpr int u = 0; \
        __VA_ARGS__          \
    }                        \
    {                        \
        constexpr int u = 1; \
        __VA_ARGS__          \
    }                        \
    {                        \
        constexpr int u = 2; \
        __VA_ARGS__          \
    }                        \
    {                        \
        constexpr int u = 3; \
        __VA_ARGS__          \
    }
#endif
#define vec3(a, b, c) make_vec3(a, b, c)
#define R(x) MM_REAL(x)
#if MM_REAL_IS_FLOAT
#define BY_PRECISION(in_double, in_float) MM_REAL(in_float)
#else
#define BY_PRECISION(in_double, in_float) MM_REAL(in_double)
#endif

typedef MM_REAL scalar;
using Reals = hn::ScalableTag<scalar>;
using Wholes = hn::RebindToSigned<Reals>;
using Int = hn::TFromD<Wholes>;

constexpr int register_lanes = static_cast<int>(hn::MaxLanes(Reals()));
constexpr int pack_lanes = MM_REGISTERS * register_lanes;

struct mask {
    hn::Mask<Reals> of[MM_REGISTERS];
};

// One whole number per lane.
struct whole {
    hn::Vec<Wholes> of[MM_REGISTERS];

    HWY_INLINE whole() = default;
    HWY_INLINE whole(Int value) { EACH_REGISTER(of[u] = hn::Set(Wholes(), value);) }
};

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
// Fast mode fuses a product with the sum or difference that it stands in. It is written out here because the compiler,
// where it may choose, can choose otherwise for another register of the same pack.
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
    hn::Mask<Reals> all = on.of[0];
    EACH_REGISTER(all = hn::Or(all, on.of[u]);)
    return !hn::AllFalse(Reals(), all);
}

FN real pick(const mask& on, const real& a, const real& b)
{
    real c;
    EACH_REGISTER(c.of[u] = hn::IfThenElse(on.of[u], a.of[u], b.of[u]);)
    return c;
}

#if HWY_ARCH_X86
// These instructions return their second operand where one is not a number, as the text asks.
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

// 1 where the lane is on, else 0.
FN whole count(const mask& on)
{
    whole c;
    EACH_REGISTER(c.of[u] = hn::IfThenElseZero(hn::RebindMask(Wholes(), on.of[u]), hn::Set(Wholes(), 1));)
    return c;
}

FN real root(real a)
{
    EACH_REGISTER(a.of[u] = hn::Sqrt(a.of[u]);)
    return a;
}

#define MM_HAS_TALLY
FN whole tally(whole a, const mask& on)
{
    EACH_REGISTER(
        a.of[u] = hn::IfThenElse(hn::RebindMask(Wholes(), on.of[u]), hn::Add(a.of[u], hn::Set(Wholes(), 1)), a.of[u]);)
    return a;
}

#if HWY_TARGET <= HWY_AVX3
#define MM_HAS_CLIPPED
// VRANGEPS with 2: the smaller magnitude, with the sign of the first.
FN real clipped(real a)
{
    const auto one = hn::Set(Reals(), MM_REAL(1));
#if MM_REAL_IS_FLOAT
    EACH_REGISTER(a.of[u].raw = _mm512_range_ps(a.of[u].raw, one.raw, 2);)
#else
    EACH_REGISTER(a.of[u].raw = _mm512_range_pd(a.of[u].raw, one.raw, 2);)
#endif
    return a;
}
#endif

#if MM_FAST && (MM_REAL_IS_FLOAT || HWY_TARGET <= HWY_AVX3)
// From the hardware's 12 or 14 bits by Newton's steps: a third of the time that division and root take.
FN hn::Vec<Reals> reciprocal(hn::Vec<Reals> b)
{
    const auto two = hn::Set(Reals(), MM_REAL(2));
#if MM_REAL_IS_FLOAT
    const auto y = hn::ApproximateReciprocal(b);
#else
    const auto first = hn::Vec<Reals>{_mm512_rcp14_pd(b.raw)};
    const auto y = hn::Mul(first, hn::NegMulAdd(b, first, two));
#endif
    return hn::Mul(y, hn::NegMulAdd(b, y, two));
}

FN hn::Vec<Reals> reciprocal_root(hn::Vec<Reals> a)
{
    const auto half = hn::Mul(a, hn::Set(Reals(), MM_REAL(0.5)));
    const auto three_halves = hn::Set(Reals(), MM_REAL(1.5));
#if MM_REAL_IS_FLOAT
    const auto y = hn::ApproximateReciprocalSqrt(a);
#else
    const auto first = hn::Vec<Reals>{_mm512_rsqrt14_pd(a.raw)};
    const auto y = hn::Mul(first, hn::NegMulAdd(hn::Mul(half, first), first, three_halves));
#endif
    return hn::Mul(y, hn::NegMulAdd(hn::Mul(half, y), y, three_halves));
}

FN real quick_quotient(real a, const real& b)
{
    EACH_REGISTER(a.of[u] = hn::Mul(a.of[u], reciprocal(b.of[u]));)
    return a;
}

FN real quick_root(real a)
{
    EACH_REGISTER(a.of[u] = hn::Mul(a.of[u], reciprocal_root(a.of[u]));)
    return a;
}

FN real quick_inverse_root(real a)
{
    EACH_REGISTER(a.of[u] = reciprocal_root(a.of[u]);)
    return a;
}
#else
FN real quick_quotient(const real& a, const real& b) { return quotient(a, b); }

FN real quick_root(const real& a) { return root(a); }

FN real quick_inverse_root(const real& a) { return quotient(1, root(a)); }
#endif

FN real magnitude(real a)
{
    EACH_REGISTER(a.of[u] = hn::Abs(a.of[u]);)
    return a;
}

// The nearest whole number, ties to even.
FN real nearest(real a)
{
    EACH_REGISTER(a.of[u] = hn::Round(a.of[u]);)
    return a;
}

#if HWY_TARGET <= HWY_AVX3
// floor(log2 |a|) of a normal number.
FN real exponent_of(real a)
{
#if MM_REAL_IS_FLOAT
    EACH_REGISTER(a.of[u].raw = _mm512_getexp_ps(a.of[u].raw);)
#else
    EACH_REGISTER(a.of[u].raw = _mm512_getexp_pd(a.of[u].raw);)
#endif
    return a;
}

// 2^n of a whole number n of the normal range.
FN real two_to(real n)
{
    const auto one = hn::Set(Reals(), MM_REAL(1));
#if MM_REAL_IS_FLOAT
    EACH_REGISTER(n.of[u].raw = _mm512_scalef_ps(one.raw, n.of[u].raw);)
#else
    EACH_REGISTER(n.of[u].raw = _mm512_scalef_pd(one.raw, n.of[u].raw);)
#endif
    return n;
}
#else
#if MM_REAL_IS_FLOAT
constexpr int mantissa_bits = 23;
constexpr Int exponent_mask = 0xff;
constexpr Int exponent_bias = 127;
#else
constexpr int mantissa_bits = 52;
constexpr Int exponent_mask = 0x7ff;
constexpr Int exponent_bias = 1023;
#endif

// floor(log2 |a|) of a normal number.
FN real exponent_of(real a)
{
    EACH_REGISTER(auto bits = hn::ShiftRight<mantissa_bits>(hn::BitCast(Wholes(), a.of[u]));
                  auto field = hn::And(bits, hn::Set(Wholes(), exponent_mask));
                  a.of[u] = hn::ConvertTo(Reals(), hn::Sub(field, hn::Set(Wholes(), exponent_bias)));)
    return a;
}

// 2^n of a whole number n of the normal range.
FN real two_to(real n)
{
    EACH_REGISTER(auto field = hn::Add(hn::ConvertTo(Wholes(), n.of[u]), hn::Set(Wholes(), exponent_bias));
                  n.of[u] = hn::BitCast(Reals(), hn::ShiftLeft<mantissa_bits>(field));)
    return n;
}
#endif

struct vec3 {
    real x, y, z;
};

struct alignas(4 * sizeof(scalar)) triple {
    scalar x, y, z;
};

FN vec3 make_vec3(const real& x, const real& y, const real& z) { return {x, y, z}; }
