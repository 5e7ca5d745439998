// SPDX-License-Identifier: Apache-2.0
#include "backends/cuda/module.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/text/error.h"

namespace mandelmarch::MM_MODEL {
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

int resource(void* function, int which)
{
    int value = 0;
    check(driver().resource(&value, which, function), "querying a kernel's attributes");
    return value;
}

}  // namespace

const Module::Loaded& Module::loaded()
{
    const job::Driver& d = driver();
    void* context = nullptr;
    check(d.in_use(&context), "querying the device in use");
    const std::scoped_lock lock(mutex_);
    Loaded& kernel = loaded_[context];
    if (kernel.function == nullptr) {
        void* module = nullptr;
        const int result = d.load(&module, image_);
        if (std::ranges::count(d.refusals, result) > 0) {
            throw Unavailable(fmt::format("backend {}: {}'s driver, {}, does not load the kernels, which need {}",
                                          d.model, d.vendor, job::version_of(d), MANDELMARCH_GPU_NEEDED));
        }
        check(result, "loading a kernel");
        check(d.find(&kernel.function, module, name_), "finding a kernel");
        kernel.most_threads = resource(kernel.function, job::most_threads_of_block);
    }
    if (of_thread().told != nullptr) {
        of_thread().told->push_back({.kernel = name_,
                                     .registers = resource(kernel.function, job::number_of_registers),
                                     .local_bytes = resource(kernel.function, job::bytes_of_stack)});
    }
    return kernel;
}

void Module::launch(int threads, std::initializer_list<const void*> arguments)
{
    const int block = of_thread().block;
    const Loaded& kernel = loaded();
    if (block > kernel.most_threads) {
        throw Unavailable(fmt::format("backend {}: {} threads a block given, {} at most for {}", driver().model, block,
                                      kernel.most_threads, name_));
    }
    std::vector<void*> addresses;
    for (const void* argument : arguments) addresses.push_back(const_cast<void*>(argument));
    check(driver().launch(kernel.function, static_cast<unsigned>((threads + block - 1) / block), 1, 1,
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

void wait() { check(driver().wait(), "running a kernel"); }

}  // namespace mandelmarch::MM_MODEL
