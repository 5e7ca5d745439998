// SPDX-License-Identifier: Apache-2.0
#include "core/gpu/driver.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <type_traits>

#include "core/os/stopwatch.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::job {
namespace {

// Errors of start() on a machine without a GPU; the second one is of ROCm 5.2.
constexpr std::array no_device{100, 101};

// Loads the functions of an opened library. Returns the name of a function that it lacks; empty: it has all.
std::string load_functions(Driver& driver, void* library)
{
    std::string missing;
    const auto load = [&](auto& function, const char* nvidia, const char* amd) {
        const char* name = driver.is_amd ? amd : nvidia;
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
        if (function == nullptr) missing = name;
    };
    load(driver.start, "cuInit", "hipInit");
    load(driver.version, "cuDriverGetVersion", "hipRuntimeGetVersion");
    load(driver.count, "cuDeviceGetCount", "hipGetDeviceCount");
    load(driver.device, "cuDeviceGet", "hipDeviceGet");
    load(driver.name, "cuDeviceGetName", "hipDeviceGetName");
    load(driver.attribute, "cuDeviceGetAttribute", "hipDeviceGetAttribute");
    load(driver.open, "cuDevicePrimaryCtxRetain", "hipDevicePrimaryCtxRetain");
    load(driver.use, "cuCtxSetCurrent", "hipCtxSetCurrent");
    load(driver.in_use, "cuCtxGetCurrent", "hipCtxGetCurrent");
    load(driver.wait, "cuCtxSynchronize", "hipDeviceSynchronize");
    load(driver.load, "cuModuleLoadData", "hipModuleLoadData");
    load(driver.find, "cuModuleGetFunction", "hipModuleGetFunction");
    load(driver.resource, "cuFuncGetAttribute", "hipFuncGetAttribute");
    load(driver.launch, "cuLaunchKernel", "hipModuleLaunchKernel");
    load(driver.memory, "cuMemGetInfo_v2", "hipMemGetInfo");
    load(driver.allocate, "cuMemAlloc_v2", "hipMalloc");
    load(driver.release, "cuMemFree_v2", "hipFree");
    load(driver.allocate_staging, "cuMemHostAlloc", "hipHostMalloc");
    load(driver.release_staging, "cuMemFreeHost", "hipHostFree");
    load(driver.lock, "cuMemHostRegister_v2", "hipHostRegister");
    load(driver.unlock, "cuMemHostUnregister", "hipHostUnregister");
    load(driver.upload, "cuMemcpyHtoD_v2", "hipMemcpyHtoD");
    load(driver.read_back, "cuMemcpyDtoH_v2", "hipMemcpyDtoH");
    load(driver.make_stream, "cuStreamCreate", "hipStreamCreateWithFlags");
    load(driver.make_event, "cuEventCreate", "hipEventCreateWithFlags");
    load(driver.record, "cuEventRecord", "hipEventRecord");
    load(driver.wait_for_event, "cuEventSynchronize", "hipEventSynchronize");
    load(driver.elapsed, "cuEventElapsedTime", "hipEventElapsedTime");
    load(driver.error_text, "cuGetErrorString", "hipGetErrorString");
    return missing;
}

std::string text_of(const Driver& driver, int error)
{
    const char* text = nullptr;
    if (driver.is_amd) {
        text = reinterpret_cast<const char* (*)(int)>(driver.error_text)(error);
    } else if (reinterpret_cast<int (*)(int, const char**)>(driver.error_text)(error, &text) != 0) {
        text = nullptr;
    }
    return fmt::format("{} ({})", printable(text != nullptr ? text : "unknown error"), error);
}

// Returns the driver, opened if possible.
Driver opened(Driver driver)
{
    void* library = nullptr;
    std::string errors;
    for (const char* name : driver.libraries) {
        if (library != nullptr || name == nullptr) continue;
        library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr) errors += fmt::format("{}{}", errors.empty() ? "" : "; ", printable(dlerror()));
    }
    if (library == nullptr) {
        driver.missing = fmt::format("there is no {} driver: {}", driver.vendor, errors);
        return driver;
    }
    if (const std::string lacks = load_functions(driver, library); !lacks.empty()) {
        driver.missing = fmt::format("{}'s driver is too old: it has no {}", driver.vendor, lacks);
        return driver;
    }
    const int result = driver.start(0);
    const bool none = std::ranges::count(no_device, result) > 0;
    if (result != 0 && !none) {
        driver.missing = fmt::format("{}'s driver does not start: {}", driver.vendor, text_of(driver, result));
    } else if (none || driver.count(&driver.devices) != 0 || driver.devices == 0) {
        driver.devices = 0;
        driver.missing = fmt::format("no {} GPU is here", driver.vendor);
    }
    return driver;
}

// Two events: one is recorded before some launches, the other one after them. Null: there are none.
struct Events {
    void* first = nullptr;
    void* last = nullptr;
};

// Returns the calling thread's events in the context that it uses. They are never destroyed: at the end of the process
// their driver may already be gone.
Events events_of(const Driver& driver)
{
    thread_local std::map<void*, Events> made;
    void* context = nullptr;
    if (driver.devices == 0 || driver.in_use(&context) != 0) return {};
    Events& events = made[context];
    const bool known = events.last != nullptr;
    if (!known && (driver.make_event(&events.first, 0) != 0 || driver.make_event(&events.last, 0) != 0)) events = {};
    return events;
}

}  // namespace

const Driver& nvidia_driver()
{
    static const Driver only = opened({.is_amd = false,
                                       .model = "cuda",
                                       .vendor = "NVIDIA",
                                       .api = "CUDA",
                                       .libraries = {"libcuda.so.1"},
                                       .version_units = {1000, 10},
                                       .refusals = {222, 209, 200},  // unknown version of PTX; no code for the GPU
                                       .multiprocessors = 16,
                                       .resident_threads = 39,
                                       .watchdog = 17});
    return only;
}

const Driver& amd_driver()
{
    static const Driver only = opened({.is_amd = true,
                                       .model = "hip",
                                       .vendor = "AMD",
                                       .api = "HIP",
                                       .libraries = {"libamdhip64.so.7", "libamdhip64.so.6", "libamdhip64.so.5"},
                                       .version_units = {10'000'000, 100'000},
                                       .refusals = {209, 200, 200},  // no code for the GPU, by ROCm 6.2 and later ones
                                       .multiprocessors = 63,
                                       .resident_threads = 57,
                                       .watchdog = 18});
    return only;
}

void check(const Driver& driver, int result, const char* what)
{
    if (result != 0) throw Error(fmt::format("{}: {}: {}", driver.model, what, text_of(driver, result)));
}

std::string version_of(const Driver& driver)
{
    int version = 0;
    check(driver, driver.version(&version), "querying the driver's version");
    const auto [major, minor] = driver.version_units;
    return fmt::format("{} {}.{}", driver.api, version / major, version % major / minor);
}

double seconds_on_gpu(const Driver& driver, const std::function<void()>& launch, const std::function<void()>& wait)
{
    const auto [first, last] = events_of(driver);
    const auto start = Clock::now();
    bool timed = last != nullptr && driver.record(first, nullptr) == 0;
    launch();
    timed = timed && driver.record(last, nullptr) == 0;
    if (wait) {
        wait();
    } else {
        timed = timed && driver.wait_for_event(last) == 0;
    }
    const double seconds = seconds_since(start);
    float milliseconds = 0;
    return timed && driver.elapsed(&milliseconds, first, last) == 0 ? 1e-3 * milliseconds : seconds;
}

std::shared_ptr<void> locked(const Driver& driver, std::span<std::uint8_t> memory)
{
    void* context = nullptr;
    if (driver.devices == 0 || driver.in_use(&context) != 0 || context == nullptr) return nullptr;
    if (driver.lock(memory.data(), memory.size(), 0) != 0) return nullptr;
    return {memory.data(), [&driver](void* address) { driver.unlock(address); }};
}

GpuSize size_of(const Driver& driver, int index)
{
    int device = 0;
    if (driver.devices == 0 || driver.device(&device, index) != 0) return {};
    const auto ask = [&](int what) {
        int answer = 0;
        return driver.attribute(&answer, what, device) == 0 ? answer : 0;
    };
    GpuSize size;
    if (!driver.is_amd) size.capability = 10 * ask(75) + ask(76);
    size.multiprocessors = ask(driver.multiprocessors);
    if (ask(driver.watchdog) == 0) size.resident_threads = size.multiprocessors * ask(driver.resident_threads);
    return size;
}

}  // namespace mandelmarch::job
