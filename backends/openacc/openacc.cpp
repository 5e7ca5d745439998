// SPDX-License-Identifier: Apache-2.0
// The OpenACC backend: the kernel on NVIDIA GPUs or on one thread of the host.
#include <fmt/format.h>
#include <openacc.h>

#include "core/gpu/driver.h"
#include "core/models/model.h"
#include "core/render/schedule.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace openacc {
job::DrawKernel* drawing(std::string_view variant);
job::Chains* chains(std::string_view precision);
}  // namespace openacc

namespace {

constexpr acc_device_t gpu = acc_device_nvidia;
constexpr const char* gpu_kind = "NVIDIA GPU";

// Pixels per band on the host, where bands serve only to report progress.
constexpr std::int64_t host_band = 1 << 13;
// Numbers of threads that measure the multiply-add peak. On a GPU there are several for each lane of the largest GPUs.
// On the host there are fewer, because it executes them one after the other.
constexpr int gpu_threads = 1 << 21;
constexpr int host_threads = 1 << 7;

int gpus()
{
    static const int count = acc_get_num_devices(gpu);
    return count;
}

// The device that the calling thread uses. Devices 0 to n - 1 are the n GPUs; device n is the host.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): OpenACC selects a device for each thread
thread_local int used = -1;

// Selects a device for the calling thread, unless it uses that device already: gcc's run-time library asks the driver
// many questions then.
void use(int device)
{
    if (used == device) return;
    if (device < gpus()) {
        acc_set_device_num(device, gpu);
    } else {
        // acc_set_device_type() must not be used here: it applies ACC_DEVICE_NUM to the host, too, and libgomp 14
        // hangs if the host has no device of that number.
        acc_set_device_num(0, acc_device_host);
    }
    used = device;
}

std::string text_of(int device, acc_device_property_t property)
{
    const char* text = acc_get_property_string(device, gpu, property);
    return text != nullptr && *text != '\0' ? printable(text) : "unknown";
}

class Openacc : public job::Model {
public:
    std::string_view name() const override { return "openacc"; }
    BackendInfo info() const override
    {
        return {.title = "OpenACC",
                .distribution =
                    "warps that take tiles of 8 x 4 pixels from a queue; 128 threads per block; in fast mode, another "
                    "kernel marches cones before",
                .role = Role::accelerator,
                .has_driver = true,
                .resident_warps = true,
                .gpus = gpu_kind,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    job::Kernels kernels() const override { return {openacc::drawing, openacc::chains, true}; }
    int devices() const override { return gpus() + 1; }

    job::OpenedDevice open(int index) const override
    {
        if (index < gpus()) {
            use(index);  // the driver translates the kernels
            const job::GpuSize size = job::size_of(job::nvidia_driver(), index);
            return {.device = {.name = text_of(index, acc_property_name),
                               .vendor = text_of(index, acc_property_vendor),
                               .driver = text_of(index, acc_property_driver),
                               .is_gpu = true},
                    .instruction_set = "PTX for sm_35",
                    .pixels_per_band = pixels_of_gpu(size.resident_threads),
                    .multiprocessors = size.multiprocessors,
                    .resident_warps = size.capability < 70 ? job::resident_warps_before_70 : job::resident_warps,
                    .peak_threads = gpu_threads};
        }
        const std::string name =
            fmt::format("host, one thread: {}", gpus() == 0 ? fmt::format("no {} here", gpu_kind) : "instead of a GPU");
        return {.device = {.name = name,
                           .vendor = "OpenACC run-time library",
                           .driver = "compiler " __VERSION__,
                           .is_gpu = false},
                .pixels_per_band = host_band,
                .peak_threads = host_threads,
                .note = fmt::format("runs on the {}", name)};
    }

    job::Selection select(const RendererOptions& options) const override
    {
        use(options.device);
        return nullptr;
    }

    double seconds_of(const std::function<void()>& launch) const override
    {
        return used < gpus() ? job::seconds_on_gpu(job::nvidia_driver(), launch) : Model::seconds_of(launch);
    }

    std::optional<std::size_t> free_memory(int index) const override
    {
        if (index >= gpus()) return std::nullopt;
        return acc_get_property(index, gpu, acc_property_free_memory);
    }
    void* allocate(std::size_t bytes) const override { return acc_malloc(bytes); }
    void release(void* address) const override { acc_free(address); }
    void upload(void* to, const void* from, std::size_t bytes) const override
    {
        // acc_memcpy_to_device() declares its source without const.
        acc_memcpy_to_device(to, const_cast<void*>(from), bytes);
    }
    void read_back(void* to, const void* from, std::size_t bytes) const override
    {
        acc_memcpy_from_device(to, const_cast<void*>(from), bytes);
    }
    std::shared_ptr<void> lock_memory(std::span<std::uint8_t> memory) const override
    {
        return job::locked(job::nvidia_driver(), memory);
    }
};

}  // namespace

std::unique_ptr<Backend> make_openacc_backend() { return job::backend_of(std::make_unique<Openacc>()); }

}  // namespace mandelmarch
