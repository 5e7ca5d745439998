// SPDX-License-Identifier: Apache-2.0
// The second half of pack.h, which includes it: square roots, reciprocals and powers of two.

FN real root(real a)
{
    EACH_REGISTER(a.of[u] = hn::Sqrt(a.of[u]);)
    return a;
}

#define MM_HAS_TALLY
#if MM_COUNTED
FN counter tally(counter a, const mask& on)
{
    EACH_REGISTER(
        a.of[u] = hn::IfThenElse(hn::RebindMask(Wholes(), on.of[u]), hn::Add(a.of[u], hn::Set(Wholes(), 1)), a.of[u]);)
    return a;
}
#else
FN counter tally(counter a, const mask&) { return a; }
#endif

#if HWY_TARGET <= HWY_AVX3
#define MM_HAS_CLIPPED
// Returns the smaller one of |a| and `most`, with the sign of a. (Operation 2 of VRANGEPS.)
FN real clipped(real a, scalar most)
{
    const auto one = hn::Set(Reals(), most);
#if MM_REAL_IS_FLOAT
    EACH_REGISTER(a.of[u].raw = _mm512_range_ps(a.of[u].raw, one.raw, 2);)
#else
    EACH_REGISTER(a.of[u].raw = _mm512_range_pd(a.of[u].raw, one.raw, 2);)
#endif
    return a;
}
#endif

#define MM_HAS_INVERSE_ROOT
#if MM_FAST && (MM_REAL_IS_FLOAT || HWY_TARGET <= HWY_AVX3)
// Return the hardware's approximations of 1 / b and 1 / sqrt(a): of 12 or 14 bits on x86, of 8 bits on ARM.
#if MM_REAL_IS_FLOAT
FN hn::Vec<Reals> first_reciprocal(hn::Vec<Reals> b) { return hn::ApproximateReciprocal(b); }
FN hn::Vec<Reals> first_reciprocal_root(hn::Vec<Reals> a) { return hn::ApproximateReciprocalSqrt(a); }
#else
FN hn::Vec<Reals> first_reciprocal(hn::Vec<Reals> b) { return hn::Vec<Reals>{_mm512_rcp14_pd(b.raw)}; }
FN hn::Vec<Reals> first_reciprocal_root(hn::Vec<Reals> a) { return hn::Vec<Reals>{_mm512_rsqrt14_pd(a.raw)}; }
#endif
// A Newton step doubles the bits, so one step is enough for float on x86.
constexpr bool two_newton_steps = !MM_REAL_IS_FLOAT || HWY_ARCH_ARM;

// Returns 1 / b. Newton steps refine the hardware's approximation. This takes a third of the time of a division or a
// square root.
FN hn::Vec<Reals> reciprocal(hn::Vec<Reals> b)
{
    const auto two = hn::Set(Reals(), MM_REAL(2));
    auto y = first_reciprocal(b);
    if (two_newton_steps) y = hn::Mul(y, hn::NegMulAdd(b, y, two));
    return hn::Mul(y, hn::NegMulAdd(b, y, two));
}

// Returns s / sqrt(a). The last Newton step includes the factor s.
FN hn::Vec<Reals> reciprocal_root(hn::Vec<Reals> a, MM_REAL s)
{
    auto y = first_reciprocal_root(a);
    if (two_newton_steps) {
        const auto half = hn::Mul(a, hn::Set(Reals(), MM_REAL(0.5)));
        y = hn::Mul(y, hn::NegMulAdd(hn::Mul(half, y), y, hn::Set(Reals(), MM_REAL(1.5))));
    }
    const auto scaled = hn::Mul(a, hn::Set(Reals(), MM_REAL(0.5) * s));
    return hn::Mul(y, hn::NegMulAdd(hn::Mul(scaled, y), y, hn::Set(Reals(), MM_REAL(1.5) * s)));
}

FN real quick_quotient(real a, const real& b)
{
    EACH_REGISTER(a.of[u] = hn::Mul(a.of[u], reciprocal(b.of[u]));)
    return a;
}

FN real quick_root(real a)
{
    EACH_REGISTER(a.of[u] = hn::Mul(a.of[u], reciprocal_root(a.of[u], 1));)
    return a;
}

FN real scaled_inverse_root(real a, scalar s)
{
    EACH_REGISTER(a.of[u] = reciprocal_root(a.of[u], s);)
    return a;
}
#else
FN real quick_quotient(const real& a, const real& b) { return quotient(a, b); }

FN real quick_root(const real& a) { return root(a); }

FN real scaled_inverse_root(const real& a, scalar s) { return quotient(s, root(a)); }
#endif

// Rough functions use the hardware's approximation without a Newton step. Only AVX-512's 14 bits are enough; the 12
// bits of earlier instruction sets cause visible errors.
#if MM_FAST && MM_REAL_IS_FLOAT && HWY_TARGET <= HWY_AVX3
#define MM_HAS_ROUGH
#define MM_HAS_ROUGH_LOG
FN real rough_quotient(real a, const real& b)
{
    EACH_REGISTER(a.of[u] = hn::Mul(a.of[u], hn::ApproximateReciprocal(b.of[u]));)
    return a;
}

FN real rough_root(real a)
{
    EACH_REGISTER(a.of[u] = hn::Mul(a.of[u], hn::ApproximateReciprocalSqrt(a.of[u]));)
    return a;
}

// Returns ln x for x > 0. Uses x = 2^e m with m in [0.75, 1.5), and ln m = t P(t) with t = m - 1. The polynomial P has
// degree 4 and a relative error of 5.2e-5; it was fitted by least squares, with weights that equalise the error.
FN real rough_log(real x)
{
    const auto set = [](double c) HWY_ATTR { return hn::Set(Reals(), static_cast<scalar>(c)); };
    EACH_REGISTER(const hn::Vec<Reals> m{_mm512_getmant_ps(x.of[u].raw, _MM_MANT_NORM_p75_1p5, _MM_MANT_SIGN_src)};
                  const hn::Vec<Reals> low{_mm512_getexp_ps(x.of[u].raw)};
                  const auto e = hn::IfThenElse(hn::Lt(m, set(1)), hn::Add(low, set(1)), low);
                  const auto t = hn::Sub(m, set(1));
                  auto series = hn::MulAdd(t, set(0.1380952856486245), set(-0.257922514562345));
                  series = hn::MulAdd(series, t, set(0.33849161672534245));
                  series = hn::MulAdd(series, t, set(-0.4999809350599029));
                  series = hn::MulAdd(series, t, set(0.9999487759605978));
                  x.of[u] = hn::MulAdd(e, set(0.6931471805599453), hn::Mul(series, t));)
    return x;
}

FN real over_root(real a, const real& /*less*/, const real& b)
{
    EACH_REGISTER(a.of[u] = hn::Mul(a.of[u], hn::ApproximateReciprocalSqrt(b.of[u]));)
    return a;
}
#endif

FN real magnitude(real a)
{
    EACH_REGISTER(a.of[u] = hn::Abs(a.of[u]);)
    return a;
}

// Returns the nearest integer, ties to even.
FN real nearest(real a)
{
    EACH_REGISTER(a.of[u] = hn::Round(a.of[u]);)
    return a;
}

#if HWY_TARGET <= HWY_AVX3
// Returns floor(log2 |a|) of a normal number.
FN real exponent_of(real a)
{
#if MM_REAL_IS_FLOAT
    EACH_REGISTER(a.of[u].raw = _mm512_getexp_ps(a.of[u].raw);)
#else
    EACH_REGISTER(a.of[u].raw = _mm512_getexp_pd(a.of[u].raw);)
#endif
    return a;
}

// Returns 2^n for an integer n. The result must be a normal number.
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

// Returns floor(log2 |a|) of a normal number.
FN real exponent_of(real a)
{
    EACH_REGISTER(auto bits = hn::ShiftRight<mantissa_bits>(hn::BitCast(Wholes(), a.of[u]));
                  auto field = hn::And(bits, hn::Set(Wholes(), exponent_mask));
                  a.of[u] = hn::ConvertTo(Reals(), hn::Sub(field, hn::Set(Wholes(), exponent_bias)));)
    return a;
}

// Returns 2^n for an integer n. The result must be a normal number.
FN real two_to(real n)
{
    EACH_REGISTER(auto field = hn::Add(hn::ConvertTo(Wholes(), n.of[u]), hn::Set(Wholes(), exponent_bias));
                  n.of[u] = hn::BitCast(Reals(), hn::ShiftLeft<mantissa_bits>(field));)
    return n;
}
#endif
