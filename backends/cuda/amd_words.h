// SPDX-License-Identifier: Apache-2.0
// Words for AMD's GPUs, compiled as HIP by clang, without HIP's headers and libraries; see words.h.
#pragma once

#define FN static __attribute__((device, always_inline)) inline
// Blocks have 128 threads. Without this bound the compiler leaves room for 1024 threads, and a kernel spills.
#define KERNEL extern "C" __attribute__((global, amdgpu_flat_work_group_size(1, 128))) void
#define SHARED __attribute__((shared))
#define ARGUMENT(type) const type

namespace {

FN int take(int& number) { return __hip_atomic_fetch_add(&number, 1, __ATOMIC_RELAXED, __HIP_MEMORY_SCOPE_AGENT); }

FN int thread_index()
{
    return int(__builtin_amdgcn_workgroup_id_x() * __builtin_amdgcn_workgroup_size_x() +
               __builtin_amdgcn_workitem_id_x());
}

typedef unsigned long long Lanes;
constexpr int warp_lanes = 64;

FN int lane() { return int(__builtin_amdgcn_workitem_id_x()) % warp_lanes; }

FN int warp_of_block() { return int(__builtin_amdgcn_workitem_id_x()) / warp_lanes; }

FN Lanes ballot(bool on) { return __builtin_amdgcn_ballot_w64(on); }

FN int lanes_of(Lanes lanes) { return __builtin_popcountll(lanes); }

FN int rank(Lanes lanes)
{
    return int(__builtin_amdgcn_mbcnt_hi(unsigned(lanes >> 32), __builtin_amdgcn_mbcnt_lo(unsigned(lanes), 0)));
}

FN void warp_barrier()
{
    __builtin_amdgcn_fence(__ATOMIC_ACQ_REL, "wavefront");
    __builtin_amdgcn_wave_barrier();
}

FN float reciprocal(float a) { return __builtin_amdgcn_rcpf(a); }

FN float inverse_root(float a) { return __builtin_amdgcn_rsqf(a); }

FN double reciprocal(double a) { return __builtin_amdgcn_rcp(a); }

FN double inverse_root(double a) { return __builtin_amdgcn_rsq(a); }

FN float binary_log(float a) { return __builtin_amdgcn_logf(a); }

}  // namespace
