// SPDX-License-Identifier: Apache-2.0
// Quick words of fast mode, for models whose device code g++ compiles to PTX. The assembler step (cmake/nvptx_as.in)
// makes reciprocals, square roots and binary logarithms approximate in this mode, and leaves divisions alone. Has no
// include guard; include it before core/models/pixels.h and after the definitions that pixels.h needs.
#if defined(MM_MODE_fast) && !defined(MM_EXACT_WORDS)
#define MM_HAS_QUICK
#define MM_HAS_ROUGH_LOG
namespace {

__attribute__((always_inline)) inline MM_REAL quick_quotient(MM_REAL a, MM_REAL b) { return a * (1 / b); }

#if MM_REAL_IS_FLOAT
__attribute__((always_inline)) inline float quick_root(float a) { return __builtin_sqrtf(a); }

__attribute__((always_inline)) inline float rough_log(float a) { return __builtin_log2f(a) * 0.693147181F; }
#else
__attribute__((always_inline)) inline double quick_root(double a) { return __builtin_sqrt(a); }

// Returns ln a from the exponent of a and the binary logarithm of its mantissa.
__attribute__((always_inline)) inline double rough_log(double a)
{
    const unsigned long long bits = __builtin_bit_cast(unsigned long long, a);
    const float mantissa = __builtin_bit_cast(float, (unsigned(bits >> 29) & 0x7fffffU) | 0x3f800000U);
    return (float(int(bits >> 52) - 1023) + __builtin_log2f(mantissa)) * 0.693147181F;
}
#endif

}  // namespace
#endif
