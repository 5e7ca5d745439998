// SPDX-License-Identifier: Apache-2.0
// The omptarget backend: the kernel in OpenMP's target directives, on devices of OpenMP or on the host's cores.
#include <dlfcn.h>
#include <fmt/format.h>
#include <omp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "backends/omptarget/devices.h"
#include "backends/omptarget/shape.h"
#include "core/gpu/driver.h"
#include "core/models/model.h"
#include "core/os/cores.h"
#include "core/text/error.h"

extern "C" {
extern const char mandelmarch_omptarget_library[];
extern const char mandelmarch_omptarget_library_end[];
}

namespace mandelmarch {
namespace {

// The shared library of kernels, which is embedded in the program (CMakeLists.txt).
struct Library {
    void* handle = nullptr;
    std::string failure;  // why the handle is null
};
std::string failed(const char* what)
{
    return fmt::format("its kernels cannot be loaded: {}: {}", what, strerror(errno));
}

// Loads the library from an anonymous file in memory, because dlopen() accepts only files.
Library loaded()
{
    const int file = memfd_create("omptarget_kernels", MFD_CLOEXEC);
    if (file < 0) return {nullptr, failed("memfd_create")};
    const char* at = mandelmarch_omptarget_library;
    while (at != mandelmarch_omptarget_library_end) {
        const ssize_t written = write(file, at, static_cast<std::size_t>(mandelmarch_omptarget_library_end - at));
        if (written < 0 && errno != EINTR) {
            Library none{nullptr, failed("write")};
            close(file);
            return none;
        }
        if (written > 0) at += written;
    }
    Library made;
    made.handle = dlopen(fmt::format("/proc/self/fd/{}", file).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (made.handle == nullptr) made.failure = fmt::format("its kernels cannot be loaded: {}", dlerror());
    close(file);
    return made;
}

// Returns the library; loads it on the first call.
const Library& library()
{
    static const Library only = loaded();
    return only;
}

// Returns the address of a function of the library; nullptr if the library is not loaded or has no such function.
void* symbol(const std::string& name)
{
    return library().handle == nullptr ? nullptr : dlsym(library().handle, name.c_str());
}

job::DrawKernel* drawing(std::string_view variant)
{
    return reinterpret_cast<job::DrawKernel*>(symbol(fmt::format("loops_{}", variant)));
}

job::Chains* chains(std::string_view precision)
{
    return reinterpret_cast<job::Chains*>(symbol(fmt::format("peak_{}", precision)));
}

// Restores the calling thread's device and number of threads.
struct Selected {
    int device = omp_get_default_device();
    int threads = omp_get_max_threads();
    Selected() = default;
    ~Selected()
    {
        omp_set_num_threads(threads);
        omp_set_default_device(device);
    }
    Selected(const Selected&) = delete;
    Selected& operator=(const Selected&) = delete;
};

// Device numbers are OpenMP's: the devices come first, and the host's number is the number of devices.
class Omptarget : public job::Model {
public:
    std::string_view name() const override { return "omptarget"; }
    BackendInfo info() const override
    {
        return {.title = "OpenMP target directives",
                .distribution =
                    "warps that take tiles of 8 x 4 pixels from a queue, with the same kernels as openacc; on the "
                    "host, its "
                    "threads take them",
                .has_driver = true,
                .threads = true,
                .resident_warps = true,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    std::optional<std::string> unavailable() const override
    {
        if (library().handle == nullptr) return library().failure;
        return std::nullopt;
    }
    job::Kernels kernels() const override { return {drawing, chains}; }
    int devices() const override { return omp_get_num_devices() + 1; }

    job::OpenedDevice open(int index) const override
    {
        const int gpus = omp_get_num_devices();
        if (index < gpus) return omptarget::opened(index, chains("float"));
        const std::string why =
            gpus == 0 ? fmt::format("no {} here", omptarget::kind) : fmt::format("instead of an {}", omptarget::kind);
        const std::string name = fmt::format("host, its cores: {}", why);
        return {.device = {.name = name,
                           .vendor = "OpenMP run-time library",
                           .driver = "compiler " __VERSION__,
                           .is_gpu = false},
                .threads = usable_threads(),
                .peak_threads = 1 << 10,
                .note = fmt::format("runs on the {}", name)};
    }

    job::Selection select(const RendererOptions& options) const override
    {
        auto selected = std::make_shared<Selected>();
        omp_set_default_device(options.device);
        omp_set_num_threads(options.threads > 0 ? options.threads : usable_threads());
        return selected;
    }
    int threads(const RendererOptions& options, const job::OpenedDevice& opened) const override
    {
        if (options.threads == 0 || opened.device.is_gpu) return opened.threads;
        return std::min(options.threads, omp_get_thread_limit());
    }

    double seconds_of(const std::function<void()>& launch) const override
    {
        const bool cores = omptarget::on_cpu(omp_get_default_device());
        return cores ? Model::seconds_of(launch) : job::seconds_on_gpu(job::nvidia_driver(), launch);
    }

    std::optional<std::size_t> free_memory(int index) const override
    {
        if (index >= omp_get_num_devices()) return std::nullopt;
        return omptarget::free_memory(index);
    }
    void* allocate(std::size_t bytes) const override { return omp_target_alloc(bytes, omp_get_default_device()); }
    void release(void* address) const override { omp_target_free(address, omp_get_default_device()); }
    void upload(void* to, const void* from, std::size_t bytes) const override
    {
        copy(to, from, bytes, omp_get_default_device(), omp_get_initial_device());
    }
    void read_back(void* to, const void* from, std::size_t bytes) const override
    {
        copy(to, from, bytes, omp_get_initial_device(), omp_get_default_device());
    }
    std::shared_ptr<void> lock_memory(std::span<std::uint8_t> memory) const override
    {
        return job::locked(job::nvidia_driver(), memory);
    }

private:
    static void copy(void* to, const void* from, std::size_t bytes, int to_device, int from_device)
    {
        if (omp_target_memcpy(to, from, bytes, 0, 0, to_device, from_device) != 0) {
            throw Error(fmt::format("omptarget: {} bytes could not be copied between host and device", bytes));
        }
    }
};

}  // namespace

std::unique_ptr<Backend> make_omptarget_backend() { return job::backend_of(std::make_unique<Omptarget>()); }

}  // namespace mandelmarch
