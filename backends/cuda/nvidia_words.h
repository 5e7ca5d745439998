// SPDX-License-Identifier: Apache-2.0
// Words for NVIDIA's GPUs, compiled by nvcc; see words.h.
#pragma once

#define FN static __device__ __forceinline__
#define KERNEL extern "C" __global__ void

namespace {

FN int take(int& number) { return atomicAdd(&number, 1); }

FN int thread_index() { return int(blockIdx.x * blockDim.x + threadIdx.x); }

FN void hide(int& value) { asm volatile("" : "+r"(value)); }
template <class T>
FN void hide(T*& value)
{
    asm volatile("" : "+l"(value));
}

// These instructions flush subnormal numbers to zero, which saves the scaling of such numbers before and after.
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

FN float binary_log(float a)
{
    float y;
    asm("lg2.approx.ftz.f32 %0, %1;" : "=f"(y) : "f"(a));
    return y;
}

}  // namespace
