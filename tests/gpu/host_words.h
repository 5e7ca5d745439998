// SPDX-License-Identifier: Apache-2.0
// Words for the host, in place of a GPU's (backends/cuda/words.h). A simulated GPU runs one thread after the other
// (simulated_cuda.c).
#pragma once

#include <cmath>

#define FN static inline
#define KERNEL extern "C" void
#define SHARED static
#define ARGUMENT(type) const type&

extern "C" int thread_of_launch;

namespace {

FN int take(int& number) { return number++; }

FN int thread_index() { return thread_of_launch; }

typedef int Lanes;  // of the one lane that runs
constexpr int warp_lanes = 32;

FN int lane() { return thread_of_launch % warp_lanes; }

FN int warp_of_block() { return 0; }

FN Lanes ballot(bool on) { return on ? 1 : 0; }

FN int lanes_of(Lanes lanes) { return lanes; }

FN int rank(Lanes) { return 0; }

FN void warp_barrier() {}

FN float reciprocal(float a) { return 1 / a; }

FN float inverse_root(float a) { return 1 / std::sqrt(a); }

// In double, the approximations have 20 bits, as a GPU's.
FN double with_20_bits(double a)
{
    return __builtin_bit_cast(double, __builtin_bit_cast(unsigned long long, a) >> 32 << 32);
}

FN double reciprocal(double a) { return with_20_bits(1 / a); }

FN double inverse_root(double a) { return with_20_bits(1 / std::sqrt(a)); }

FN float binary_log(float a) { return std::log2(a); }

}  // namespace
