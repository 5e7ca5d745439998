// SPDX-License-Identifier: Apache-2.0
// Adds to the scalar prelude what CUDA and HIP need. FN declares functions that run on the device, and KERNEL declares
// kernels. thread_index() returns a thread's index in the launch. hide() makes the compiler assume that a value has
// changed. take() increments a number in memory as an atomic operation, and returns the number before. reciprocal(),
// inverse_root() and binary_log() are approximate instructions.
#pragma once

#ifdef __HIP__
#include "backends/cuda/amd_words.h"
#elif !defined(KERNEL)  // A test defines the words for the host.
#include "backends/cuda/nvidia_words.h"
#endif

namespace {

#if defined(MM_MODE_fast) && MM_REAL_IS_FLOAT
// Words of fast mode in float, by the approximations that a GPU has as instructions. Their errors are at most two units
// in the last place.
#define MM_HAS_QUICK
#define MM_HAS_INVERSE_ROOT
#define MM_HAS_ROUGH
#define MM_HAS_ROUGH_LOG
#define MM_HAS_LARGER

FN float quick_quotient(float a, float b) { return a * reciprocal(b); }

FN float quick_root(float a) { return a * inverse_root(a); }

FN float scaled_inverse_root(float a, float s) { return s * inverse_root(a); }

FN float rough_quotient(float a, float b) { return quick_quotient(a, b); }

FN float rough_root(float a) { return quick_root(a); }

FN float over_root(float a, float, float b) { return a * inverse_root(b); }

// Returns ln a, with an error of 2^-22, absolute near a = 1 and relative elsewhere.
FN float rough_log(float a) { return binary_log(a) * 0.693147181F; }

// One instruction each. They return the other operand if one is NaN.
FN float larger(float a, float b) { return __builtin_fmaxf(a, b); }

FN float smaller(float a, float b) { return __builtin_fminf(a, b); }
#endif

}  // namespace
#define MM_ANEW(value) hide(value)
#define MM_TAKE(number) take(number)
