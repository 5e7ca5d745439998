// SPDX-License-Identifier: Apache-2.0
#include "backends/cuda/module.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace mandelmarch::cuda {
namespace {

// Settings of the calling thread.
struct OfThread {
    std::vector<KernelResources>* told = nullptr;  // result of loaded_by(), while it runs; null at other times
    int block = job::block_threads;
};

OfThread& of_thread()
{
    thread_local OfThread state;
    return state;
}

int attribute(CUfunction function, CUfunction_attribute which)
{
    int value = 0;
    check(driver().cuFuncGetAttribute(&value, which, function), "querying a kernel's attributes");
    return value;
}

std::string too_old()
{
    int version = 0;
    check(driver().cuDriverGetVersion(&version), "querying the driver's version");
    return fmt::format("backend cuda: NVIDIA's driver is for CUDA {}.{}, the kernels need one for CUDA {} or newer",
                       version / 1000, version % 1000 / 10, MANDELMARCH_CUDA_TOOLKIT);
}

}  // namespace

const Module::Loaded& Module::loaded()
{
    const Driver& d = driver();
    CUcontext context = nullptr;
    check(d.cuCtxGetCurrent(&context), "querying the device in use");
    const std::scoped_lock lock(mutex_);
    Loaded& kernel = loaded_[context];
    if (kernel.function == nullptr) {
        CUmodule module = nullptr;
        const CUresult result = d.cuModuleLoadData(&module, ptx_);
        if (result == CUDA_ERROR_UNSUPPORTED_PTX_VERSION) throw Unavailable(too_old());
        check(result, "loading a kernel");
        check(d.cuModuleGetFunction(&kernel.function, module, name_), "finding a kernel");
        kernel.most_threads = attribute(kernel.function, CU_FUNC_ATTRIBUTE_MAX_THREADS_PER_BLOCK);
    }
    if (of_thread().told != nullptr) {
        of_thread().told->push_back({.kernel = name_,
                                     .registers = attribute(kernel.function, CU_FUNC_ATTRIBUTE_NUM_REGS),
                                     .local_bytes = attribute(kernel.function, CU_FUNC_ATTRIBUTE_LOCAL_SIZE_BYTES)});
    }
    return kernel;
}

void Module::launch(int threads, std::initializer_list<const void*> arguments)
{
    const int block = of_thread().block;
    const Loaded& kernel = loaded();
    if (block > kernel.most_threads) {
        throw Unavailable(fmt::format("backend cuda: {} threads a block given, {} at most for {}", block,
                                      kernel.most_threads, name_));
    }
    std::vector<void*> addresses;
    for (const void* argument : arguments) addresses.push_back(const_cast<void*>(argument));
    check(driver().cuLaunchKernel(kernel.function, static_cast<unsigned>((threads + block - 1) / block), 1, 1,
                                  static_cast<unsigned>(block), 1, 1, 0, nullptr, addresses.data(), nullptr),
          "launching a kernel");
}

void use_blocks_of(int threads) { of_thread().block = threads > 0 ? threads : job::block_threads; }

std::vector<KernelResources> loaded_by(const std::function<void()>& load)
{
    std::vector<KernelResources> resources;
    of_thread().told = &resources;
    try {
        load();
    } catch (...) {
        of_thread().told = nullptr;
        throw;
    }
    of_thread().told = nullptr;
    return resources;
}

void wait() { check(driver().cuCtxSynchronize(), "running a kernel"); }

}  // namespace mandelmarch::cuda
