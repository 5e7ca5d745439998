// SPDX-License-Identifier: Apache-2.0
// Measures the multiply-add peak of this machine's cores, with SIMD instructions.
#pragma once

#include <cstdint>

#include "core/render/backend.h"

namespace mandelmarch::openmp {

// A function that measures the peak, for one instruction set. `run` executes `rounds` iterations of
// multiply_add_chains on one thread and returns their result, so that the compiler cannot remove them. Plain data, as
// in variant.h.
struct PeakKernel {
    int lanes;
    double (*run)(int rounds);
};

PeakKernel peak_kernel_float(std::int64_t targets);
PeakKernel peak_kernel_double(std::int64_t targets);

// Returns the operations per second of `threads` threads together; 0 threads: usable_threads().
double multiply_add_peak(Precision precision, int threads);

}  // namespace mandelmarch::openmp
