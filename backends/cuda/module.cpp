// SPDX-License-Identifier: Apache-2.0
#include "backends/cuda/module.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/text/error.h"

namespace mandelmarch::MM_MODEL {
namespace {

// Returns the result of the calling thread's loaded_by(), while it runs; null at other times.
std::vector<KernelResources>*& resources_of_thread()
{
    thread_local std::vector<KernelResources>* resources = nullptr;
    return resources;
}

int resource(void* function, int which)
{
    int value = 0;
    check(driver().resource(&value, which, function), "querying a kernel's attributes");
    return value;
}

// Returns a stream of the calling thread in the context that it uses. Streams are never destroyed, as events_of() in
// core/gpu/driver.cpp.
void* stream_of(std::size_t number)
{
    thread_local std::map<void*, std::vector<void*>> made;
    if (number == 0) return nullptr;
    void* context = nullptr;
    check(driver().in_use(&context), "querying the device in use");
    std::vector<void*>& streams = made[context];
    while (streams.size() < number) {
        void* stream = nullptr;
        check(driver().make_stream(&stream, 0), "making a stream");
        streams.push_back(stream);
    }
    return streams[number - 1];
}

}  // namespace

void* Module::loaded()
{
    const job::Driver& d = driver();
    void* context = nullptr;
    check(d.in_use(&context), "querying the device in use");
    const std::scoped_lock lock(mutex_);
    void*& kernel = loaded_[context];
    if (kernel == nullptr) {
        void* module = nullptr;
        const int result = d.load(&module, image_);
        if (std::ranges::count(d.refusals, result) > 0) {
            throw Unavailable(fmt::format("backend {}: {}'s driver, {}, does not load the kernels, which need {}",
                                          d.model, d.vendor, job::version_of(d), MANDELMARCH_GPU_NEEDED));
        }
        check(result, "loading a kernel");
        check(d.find(&kernel, module, name_), "finding a kernel");
    }
    if (auto* const resources = resources_of_thread()) {
        resources->push_back({.kernel = name_,
                              .registers = resource(kernel, job::number_of_registers),
                              .local_bytes = resource(kernel, job::bytes_of_stack)});
    }
    return kernel;
}

void Module::launch(int threads, std::initializer_list<const void*> arguments, std::size_t stream)
{
    void* const kernel = loaded();
    std::vector<void*> addresses;
    for (const void* argument : arguments) addresses.push_back(const_cast<void*>(argument));
    constexpr int block = job::block_threads;
    check(driver().launch(kernel, static_cast<unsigned>((threads + block - 1) / block), 1, 1, block, 1, 1, 0,
                          stream_of(stream), addresses.data(), nullptr),
          "launching a kernel");
}

std::vector<KernelResources> loaded_by(const std::function<void()>& load)
{
    std::vector<KernelResources> resources;
    resources_of_thread() = &resources;
    try {
        load();
    } catch (...) {
        resources_of_thread() = nullptr;
        throw;
    }
    resources_of_thread() = nullptr;
    return resources;
}

void wait() { check(driver().wait(), "running a kernel"); }

}  // namespace mandelmarch::MM_MODEL
