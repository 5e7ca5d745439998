// SPDX-License-Identifier: Apache-2.0
// NVIDIA's driver library, opened when first asked for, so that a program runs where there is none.
#pragma once

#include <cuda.h>

#include <string>

namespace mandelmarch::cuda {

#define MM_DRIVER_FUNCTIONS(NAME)  \
    NAME(cuInit)                   \
    NAME(cuDriverGetVersion)       \
    NAME(cuDeviceGetCount)         \
    NAME(cuDeviceGet)              \
    NAME(cuDeviceGetName)          \
    NAME(cuDeviceGetAttribute)     \
    NAME(cuDevicePrimaryCtxRetain) \
    NAME(cuCtxSetCurrent)          \
    NAME(cuCtxGetCurrent)          \
    NAME(cuCtxSynchronize)         \
    NAME(cuModuleLoadData)         \
    NAME(cuModuleGetFunction)      \
    NAME(cuFuncGetAttribute)       \
    NAME(cuLaunchKernel)           \
    NAME(cuMemGetInfo)             \
    NAME(cuMemAlloc)               \
    NAME(cuMemFree)                \
    NAME(cuMemAllocHost)           \
    NAME(cuMemFreeHost)            \
    NAME(cuMemcpyHtoD)             \
    NAME(cuMemcpyDtoH)             \
    NAME(cuGetErrorString)

// cuda.h gives some names a version: cuMemAlloc is cuMemAlloc_v2 here, too.
struct Driver {
#define MM_MEMBER(name) decltype(&::name) name = nullptr;
    MM_DRIVER_FUNCTIONS(MM_MEMBER)
#undef MM_MEMBER
    int devices = 0;
    std::string missing;  // why there are no devices
};

const Driver& driver();

// Throws Error, with what was done, unless the driver's answer is CUDA_SUCCESS.
void check(CUresult result, const char* what);

}  // namespace mandelmarch::cuda
