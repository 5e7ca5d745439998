// SPDX-License-Identifier: Apache-2.0
#include "backends/cuda/module.h"

#include <vector>

namespace mandelmarch::cuda {

CUfunction Module::load()
{
    const Driver& d = driver();
    CUcontext context = nullptr;
    check(d.cuCtxGetCurrent(&context), "asking for the device");
    const std::scoped_lock lock(mutex_);
    if (const auto known = loaded_.find(context); known != loaded_.end()) return known->second;
    CUmodule module = nullptr;
    CUfunction function = nullptr;
    check(d.cuModuleLoadData(&module, ptx_), "loading a kernel");
    check(d.cuModuleGetFunction(&function, module, name_), "finding a kernel");
    loaded_[context] = function;
    return function;
}

void Module::launch(int blocks, std::initializer_list<const void*> arguments)
{
    std::vector<void*> addresses;
    for (const void* argument : arguments) addresses.push_back(const_cast<void*>(argument));
    check(driver().cuLaunchKernel(load(), static_cast<unsigned>(blocks), 1, 1, job::block_threads, 1, 1, 0, nullptr,
                                  addresses.data(), nullptr),
          "launching a kernel");
}

void wait() { check(driver().cuCtxSynchronize(), "running a kernel"); }

}  // namespace mandelmarch::cuda
