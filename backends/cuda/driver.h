// SPDX-License-Identifier: Apache-2.0
// NVIDIA's driver library, loaded on first use, so that programs also run without it.
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

// Pointers to the driver's functions. Each member is named like its function after macro expansion: cuda.h defines
// cuMemAlloc as cuMemAlloc_v2, so both the member and the loaded function are named cuMemAlloc_v2.
struct Driver {
#define MM_MEMBER(name) decltype(&::name) name = nullptr;
    MM_DRIVER_FUNCTIONS(MM_MEMBER)
#undef MM_MEMBER
    int devices = 0;
    std::string missing;  // why no devices are available
};

const Driver& driver();

// Throws Error with `what`, the failed action, unless the result is CUDA_SUCCESS.
void check(CUresult result, const char* what);

}  // namespace mandelmarch::cuda
