// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of this machine's cores, in SIMD registers.
#pragma once

#include <cstdint>

#include "core/render/backend.h"

namespace mandelmarch::openmp {

// A peak kernel for one instruction set: `run` does `rounds` rounds of multiply_add_chains on one thread and returns
// what the chains come to, so that no compiler drops them. Plain data, as variant.h says.
struct PeakKernel {
    int lanes;
    double (*run)(int rounds);
};

PeakKernel peak_kernel_float(std::int64_t targets);
PeakKernel peak_kernel_double(std::int64_t targets);

// Operations per second of `threads` threads (0: one a core).
double multiply_add_peak(Precision precision, int threads);

}  // namespace mandelmarch::openmp
