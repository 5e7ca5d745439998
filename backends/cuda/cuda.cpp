// SPDX-License-Identifier: Apache-2.0
// The cuda backend: the kernel in CUDA, on NVIDIA GPUs.
#include <fmt/format.h>

#include <array>
#include <map>
#include <mutex>

#include "backends/cuda/driver.h"
#include "backends/cuda/module.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/job/model.h"
#include "core/job/nvidia.h"

namespace mandelmarch {
namespace cuda {
job::DrawKernel* drawing(std::string_view variant);
job::Chains* chains(std::string_view precision);
}  // namespace cuda

namespace {

using cuda::check;
using cuda::driver;

CUdeviceptr device_address(const void* address) { return reinterpret_cast<CUdeviceptr>(address); }

int attribute(CUdevice device, CUdevice_attribute which)
{
    int value = 0;
    check(driver().cuDeviceGetAttribute(&value, which, device), "querying the device's attributes");
    return value;
}

class Cuda : public job::Model {
public:
    std::string_view name() const override { return "cuda"; }
    BackendInfo info() const override
    {
        return {.has_driver = true,
                .block_size = true,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    std::optional<std::string> unavailable() const override
    {
        if (driver().devices == 0) return driver().missing;
        return std::nullopt;
    }
    job::Kernels kernels() const override { return {cuda::drawing, cuda::chains}; }
    std::vector<KernelResources> build(job::DrawKernel* launch) const override
    {
        return cuda::loaded_by([&] { launch(nullptr, {}); });
    }
    int devices() const override { return driver().devices; }

    job::OpenedDevice open(int index) const override
    {
        CUdevice device = 0;
        CUcontext context = nullptr;
        std::array<char, 256> name{};
        int version = 0;
        check(driver().cuDeviceGet(&device, index), "finding the device");
        check(driver().cuDeviceGetName(name.data(), static_cast<int>(name.size()), device),
              "querying the device's name");
        check(driver().cuDriverGetVersion(&version), "querying the driver's version");
        const int capability = 10 * attribute(device, CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR) +
                               attribute(device, CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR);
        check(driver().cuDevicePrimaryCtxRetain(&context, device), "opening the device");
        const std::scoped_lock lock(mutex_);
        contexts_[index] = context;
        capabilities_[index] = capability;
        const std::int64_t pixels = job::pixels_per_launch(index);
        return {.device = {.name = printable(name.data()),
                           .vendor = "NVIDIA",
                           .driver = fmt::format("CUDA {}.{}", version / 1000, version % 1000 / 10),
                           .is_gpu = true},
                .instruction_set = fmt::format("PTX for compute_{}", MANDELMARCH_CUDA_LOWEST),
                .pixels_per_band = pixels,
                .refill_lanes = job::knows_threads(pixels),
                .peak_threads = 1 << 21};
    }

    void run(const RendererOptions& options, const std::function<void()>& draw) const override
    {
        CUcontext context = nullptr;
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
        check(driver().cuCtxSetCurrent(context), "using the device");
        cuda::use_blocks_of(options.block_size);
        draw();
    }

    double seconds_of(const std::function<void()>& launch) const override
    {
        return job::seconds_on_gpu(launch, cuda::wait);
    }

    std::optional<std::size_t> free_memory(int) const override
    {
        std::size_t free = 0;
        std::size_t total = 0;
        check(driver().cuMemGetInfo(&free, &total), "querying the device's memory");
        return free;
    }
    void* allocate(std::size_t bytes) const override
    {
        CUdeviceptr address = 0;
        const CUresult result = driver().cuMemAlloc(&address, bytes);
        if (result == CUDA_ERROR_OUT_OF_MEMORY) return nullptr;
        check(result, "allocating device memory");
        return reinterpret_cast<void*>(address);  // NOLINT(performance-no-int-to-ptr): CUdeviceptr is an integer
    }
    void release(void* address) const override { driver().cuMemFree(device_address(address)); }
    void upload(void* to, const void* from, std::size_t bytes) const override
    {
        check(driver().cuMemcpyHtoD(device_address(to), from, bytes), "copying to the device");
    }
    void read_back(void* to, const void* from, std::size_t bytes) const override
    {
        check(driver().cuMemcpyDtoH(to, device_address(from), bytes), "copying from the device");
    }

    void* allocate_staging(std::size_t bytes) const override
    {
        void* address = nullptr;
        return driver().cuMemAllocHost(&address, bytes) == CUDA_SUCCESS ? address : nullptr;
    }
    void release_staging(void* address) const override { driver().cuMemFreeHost(address); }

private:
    mutable std::mutex mutex_;
    mutable std::map<int, CUcontext> contexts_;
    mutable std::map<int, int> capabilities_;
};

}  // namespace

std::unique_ptr<Backend> make_cuda_backend() { return job::backend_of(std::make_unique<Cuda>()); }

}  // namespace mandelmarch
