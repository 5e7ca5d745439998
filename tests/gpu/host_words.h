// SPDX-License-Identifier: Apache-2.0
// Words for the host, in place of a GPU's (backends/cuda/words.h). A simulated GPU runs one thread after the other
// (simulated_cuda.c).
#pragma once

#include <cmath>

#define FN static inline
#define KERNEL extern "C" void

extern "C" int thread_of_launch;

namespace {

FN int take(int& number) { return number++; }

FN int thread_index() { return thread_of_launch; }

template <class T>
FN void hide(T& value)
{
    asm volatile("" : "+r"(value));
}

FN float reciprocal(float a) { return 1 / a; }

FN float inverse_root(float a) { return 1 / std::sqrt(a); }

FN float binary_log(float a) { return std::log2(a); }

}  // namespace
