// SPDX-License-Identifier: Apache-2.0
// The kernels that measure the multiply-add peak of this machine's cores, with SIMD instructions (peak_packs.cpp.in).
#pragma once

#include <cstdint>

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

}  // namespace mandelmarch::openmp
