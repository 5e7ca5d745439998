// SPDX-License-Identifier: Apache-2.0
// Words for AMD's GPUs, compiled as HIP by clang, without HIP's headers and libraries; see words.h.
#pragma once

#define FN static __attribute__((device, always_inline)) inline
// Blocks have at most 512 threads. Without this bound the compiler leaves room for 1024 threads, and a kernel spills.
#define KERNEL extern "C" __attribute__((global, amdgpu_flat_work_group_size(1, 512))) void

namespace {

FN int take(int& number) { return __hip_atomic_fetch_add(&number, 1, __ATOMIC_RELAXED, __HIP_MEMORY_SCOPE_AGENT); }

FN int thread_index()
{
    return int(__builtin_amdgcn_workgroup_id_x() * __builtin_amdgcn_workgroup_size_x() +
               __builtin_amdgcn_workitem_id_x());
}

FN void hide(int& value) { asm volatile("" : "+v"(value)); }
// Keeps the pointer in scalar registers, as it has the same value in all threads.
template <class T>
FN void hide(T*& value)
{
    asm volatile("" : "+s"(value));
}

FN float reciprocal(float a) { return __builtin_amdgcn_rcpf(a); }

FN float inverse_root(float a) { return __builtin_amdgcn_rsqf(a); }

FN float binary_log(float a) { return __builtin_amdgcn_logf(a); }

}  // namespace
