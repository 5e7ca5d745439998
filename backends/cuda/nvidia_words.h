// SPDX-License-Identifier: Apache-2.0
// Words for NVIDIA's GPUs, compiled by nvcc; see words.h.
#pragma once

#define FN static __device__ __forceinline__
// With at most 128 registers, four blocks are resident at once (resident_warps in core/models/job.h).
#define KERNEL extern "C" __global__ void __launch_bounds__(128, 4)
#define SHARED __shared__
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ < 700
#define ARGUMENT(type) const type
#else
#define ARGUMENT(type) const __grid_constant__ type
#endif

namespace {

FN int take(int& number) { return atomicAdd(&number, 1); }

FN int thread_index() { return int(blockIdx.x * blockDim.x + threadIdx.x); }

typedef unsigned Lanes;
constexpr int warp_lanes = 32;

FN int lane() { return int(threadIdx.x) % warp_lanes; }

FN int warp_of_block() { return int(threadIdx.x) / warp_lanes; }

FN Lanes ballot(bool on) { return __ballot_sync(0xffffffffU, on); }

FN int lanes_of(Lanes lanes) { return __popc(lanes); }

FN int rank(Lanes lanes)
{
    unsigned before;
    asm("mov.u32 %0, %%lanemask_lt;" : "=r"(before));
    return __popc(lanes & before);
}

FN void warp_barrier() { __syncwarp(); }

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

FN double reciprocal(double a)
{
    double y;
    asm("rcp.approx.ftz.f64 %0, %1;" : "=d"(y) : "d"(a));
    return y;
}

FN double inverse_root(double a)
{
    double y;
    asm("rsqrt.approx.ftz.f64 %0, %1;" : "=d"(y) : "d"(a));
    return y;
}

FN float binary_log(float a)
{
    float y;
    asm("lg2.approx.ftz.f32 %0, %1;" : "=f"(y) : "f"(a));
    return y;
}

}  // namespace
