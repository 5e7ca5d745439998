// SPDX-License-Identifier: Apache-2.0
// The second half of opencl.h, which includes it: the quick and rough words. In fast mode they use a device's
// approximations: of GPUs if MM_NATIVE is 1 (in float, and with one lane), and of CPUs with AVX-512 if the compiler is
// clang.

#if MM_NATIVE
#define MM_HAS_INVERSE_ROOT
#define MM_HAS_ROUGH
#define MM_HAS_ROUGH_LOG
#define MM_HAS_LARGER
FN real quick_quotient(real a, real b) { return native_divide(a, b); }

FN real quick_root(real a) { return a * native_rsqrt(a); }

FN real scaled_inverse_root(real a, scalar s) { return s * native_rsqrt(a); }

FN real rough_quotient(real a, real b) { return quick_quotient(a, b); }

FN real rough_root(real a) { return quick_root(a); }

FN real over_root(real a, real less, real b) { return a * native_rsqrt(b); }

FN real rough_log(real a) { return native_log(a); }

// If one operand is NaN, these return the other one.
FN real larger(real a, real b) { return fmax(a, b); }

FN real smaller(real a, real b) { return fmin(a, b); }

#elif defined(MM_AVX512) && !MM_EXACT
// first_reciprocal() and first_inverse_root() return 1 / a and 1 / sqrt(a), accurate to 14 bits, by one instruction for
// each register.
#if MM_REAL_IS_FLOAT
FN float16 reciprocal_16(float16 a) { return __builtin_ia32_rcp14ps512_mask(a, a, (ushort)-1); }

FN real first_reciprocal(real a) { return MM_BY_HALVES(real, reciprocal_16, a); }

FN float16 inverse_root_16(float16 a) { return __builtin_ia32_rsqrt14ps512_mask(a, a, (ushort)-1); }
#else
FN double8 inverse_root_8(double8 a) { return __builtin_ia32_rsqrt14pd512_mask(a, a, (uchar)-1); }

FN double16 inverse_root_16(double16 a) { return (double16)(inverse_root_8(a.lo), inverse_root_8(a.hi)); }
#endif

#if MM_LANES == 8
FN real first_inverse_root(real a) { return inverse_root_8(a); }
#else
FN real first_inverse_root(real a) { return MM_BY_HALVES(real, inverse_root_16, a); }
#endif

// Returns s / sqrt(a) by a Newton step from y, an approximation of 1 / sqrt(a).
FN real closer_inverse_root(real a, real y, scalar s) { return s * y + (R(0.5) * s * y) * (R(1.0) - (a * y) * y); }

// CPUs divide in a separate unit while they multiply and add. A Newton step would need the units that multiply and add.
// Therefore quotients are approximate only where 14 bits suffice. In double, square roots without a division are exact
// for the same reason.
FN real quick_quotient(real a, real b) { return quotient(a, b); }

#define MM_HAS_INVERSE_ROOT
#if MM_REAL_IS_FLOAT
FN real scaled_inverse_root(real a, scalar s) { return closer_inverse_root(a, first_inverse_root(a), s); }

FN real quick_root(real a) { return a * scaled_inverse_root(a, 1); }

#define MM_HAS_ROUGH
FN real rough_quotient(real a, real b) { return a * first_reciprocal(b); }

FN real rough_root(real a) { return a * first_inverse_root(a); }

FN real over_root(real a, real less, real b) { return a * first_inverse_root(b); }
#else
FN real scaled_inverse_root(real a, scalar s)
{
    return closer_inverse_root(a, closer_inverse_root(a, first_inverse_root(a), 1), s);
}

FN real quick_root(real a) { return root(a); }
#endif

#else
FN real quick_quotient(real a, real b) { return quotient(a, b); }

FN real quick_root(real a) { return root(a); }
#endif
