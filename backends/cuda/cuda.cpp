// SPDX-License-Identifier: Apache-2.0
// The backends cuda and hip: the kernel in CUDA on NVIDIA's GPUs, and in HIP on AMD's.
#include <fmt/format.h>

#include <array>
#include <map>
#include <mutex>

#include "backends/cuda/module.h"
#include "core/text/error.h"
#include "core/text/text.h"
#include "core/models/model.h"
#include "core/render/schedule.h"

namespace mandelmarch {
namespace MM_MODEL {
job::DrawKernel* drawing(std::string_view variant);
job::Chains* chains(std::string_view precision);
}  // namespace MM_MODEL

namespace {

using MM_MODEL::check;
using MM_MODEL::driver;

class Gpu : public job::Model {
public:
    std::string_view name() const override { return MANDELMARCH_GPU_MODEL; }
    BackendInfo info() const override
    {
        return {.title = std::string_view(MANDELMARCH_GPU_MODEL) == "hip" ? "HIP" : "CUDA",
                .distribution = "warps that take pixels from a queue and shade their hits together",
                .has_driver = true,
                .resident_warps = true,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    std::optional<std::string> unavailable() const override
    {
        if (driver().devices == 0) return driver().missing;
        return std::nullopt;
    }
    job::Kernels kernels() const override { return {MM_MODEL::drawing, MM_MODEL::chains, true}; }
    std::vector<KernelResources> build(job::DrawKernel* launch) const override
    {
        return MM_MODEL::loaded_by([&] { launch({}); });
    }
    int devices() const override { return driver().devices; }

    job::OpenedDevice open(int index) const override
    {
        int device = 0;
        void* context = nullptr;
        std::array<char, 256> name{};
        check(driver().device(&device, index), "finding the device");
        check(driver().name(name.data(), static_cast<int>(name.size()), device), "querying the device's name");
        check(driver().open(&context, device), "opening the device");
        const std::scoped_lock lock(mutex_);
        contexts_[index] = context;
        const job::GpuSize size = job::size_of(driver(), index);
        capabilities_[index] = size.capability;
        return {.device = {.name = printable(name.data()),
                           .vendor = driver().vendor,
                           .driver = job::version_of(driver()),
                           .is_gpu = true},
                .instruction_set = MANDELMARCH_GPU_CODE,
                .pixels_per_band = pixels_of_gpu(size.resident_threads),
                .multiprocessors = size.multiprocessors,
                .peak_threads = 1 << 21};
    }

    job::Selection select(const RendererOptions& options) const override
    {
        void* context = nullptr;
        {
            const std::scoped_lock lock(mutex_);
            if (capabilities_.at(options.device) < MANDELMARCH_CUDA_LOWEST) {
                throw Unavailable(
                    fmt::format("backend cuda: its kernels are for GPUs of compute capability {} and up, "
                                "device {} has {}",
                                MANDELMARCH_CUDA_LOWEST, options.device, capabilities_.at(options.device)));
            }
            context = contexts_.at(options.device);
        }
        check(driver().use(context), "using the device");
        return nullptr;
    }

    double seconds_of(const std::function<void()>& launch) const override
    {
        return job::seconds_on_gpu(driver(), launch, MM_MODEL::wait);
    }

    std::optional<std::size_t> free_memory(int) const override
    {
        std::size_t free = 0;
        std::size_t total = 0;
        check(driver().memory(&free, &total), "querying the device's memory");
        return free;
    }
    void* allocate(std::size_t bytes) const override
    {
        void* address = nullptr;
        const int result = driver().allocate(&address, bytes);
        if (result == job::out_of_memory) return nullptr;
        check(result, "allocating device memory");
        return address;
    }
    void release(void* address) const override { driver().release(address); }
    void upload(void* to, const void* from, std::size_t bytes) const override
    {
        check(driver().upload(to, from, bytes), "copying to the device");
    }
    void read_back(void* to, const void* from, std::size_t bytes) const override
    {
        check(driver().read_back(to, from, bytes), "copying from the device");
    }

    void* allocate_staging(std::size_t bytes) const override
    {
        void* address = nullptr;
        return driver().allocate_staging(&address, bytes, 0) == 0 ? address : nullptr;
    }
    void release_staging(void* address) const override { driver().release_staging(address); }
    std::shared_ptr<void> lock_memory(std::span<std::uint8_t> memory) const override
    {
        return job::locked(driver(), memory);
    }

private:
    mutable std::mutex mutex_;
    mutable std::map<int, void*> contexts_;
    mutable std::map<int, int> capabilities_;
};

}  // namespace

std::unique_ptr<Backend> MM_FACTORY() { return job::backend_of(std::make_unique<Gpu>()); }

}  // namespace mandelmarch
