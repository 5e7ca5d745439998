// SPDX-License-Identifier: Apache-2.0
// Quick words of fast mode in float, for models whose device code g++ compiles to PTX. The assembler step
// (cmake/nvptx_as.in) makes reciprocals and square roots approximate in this mode, and leaves divisions alone. Has no
// include guard; include it before core/models/pixels.h and after the definitions that pixels.h needs.
#if defined(MM_MODE_fast) && MM_REAL_IS_FLOAT
#define MM_HAS_QUICK
namespace {

__attribute__((always_inline)) inline float quick_quotient(float a, float b) { return a * (1 / b); }

__attribute__((always_inline)) inline float quick_root(float a) { return __builtin_sqrtf(a); }

}  // namespace
#endif
