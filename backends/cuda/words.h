// SPDX-License-Identifier: Apache-2.0
// Adds to the scalar prelude what CUDA needs. FN declares functions that run on the device. hide() makes the compiler
// assume that a value has changed.
#pragma once

#define FN static __device__ __forceinline__

namespace {

FN void hide(int& value) { asm volatile("" : "+r"(value)); }
template <class T>
FN void hide(T*& value)
{
    asm volatile("" : "+l"(value));
}

#if defined(MM_MODE_fast) && MM_REAL_IS_FLOAT
// Words of fast mode in float, by the approximations that a GPU has as instructions. Their errors are at most two units
// in the last place. They flush subnormal numbers to zero, which saves the scaling of such numbers before and after.
#define MM_HAS_QUICK
#define MM_HAS_INVERSE_ROOT
#define MM_HAS_ROUGH
#define MM_HAS_ROUGH_LOG
#define MM_HAS_LARGER

FN float reciprocal(float a)
{
    float y;
    asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(y) : "f"(a));
    return y;
}

FN float inverse_root(float a)
{
    float y;
    asm("rsqrt.approx.ftz.f32 %0, %1;" : "=f"(y) : "f"(a));
    return y;
}

FN float quick_quotient(float a, float b) { return a * reciprocal(b); }

FN float quick_root(float a) { return a * inverse_root(a); }

FN float scaled_inverse_root(float a, float s) { return s * inverse_root(a); }

FN float rough_quotient(float a, float b) { return quick_quotient(a, b); }

FN float rough_root(float a) { return quick_root(a); }

FN float over_root(float a, float, float b) { return a * inverse_root(b); }

// Returns ln a, with an error of 2^-22, absolute near a = 1 and relative elsewhere.
FN float rough_log(float a)
{
    float y;
    asm("lg2.approx.ftz.f32 %0, %1;" : "=f"(y) : "f"(a));
    return y * 0.693147181F;
}

// One instruction each. They return the other operand if one is NaN.
FN float larger(float a, float b) { return fmaxf(a, b); }

FN float smaller(float a, float b) { return fminf(a, b); }
#endif

}  // namespace
#define MM_ANEW(value) hide(value)
