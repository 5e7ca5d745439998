// SPDX-License-Identifier: Apache-2.0
#include "backends/cuda/driver.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace mandelmarch::cuda {
namespace {

constexpr const char* library = "libcuda.so.1";

std::string text_of(const Driver& driver, CUresult result)
{
    const char* text = nullptr;
    if (driver.cuGetErrorString(result, &text) != CUDA_SUCCESS || text == nullptr) text = "unknown error";
    return fmt::format("{} ({})", printable(text), static_cast<int>(result));
}

Driver opened()
{
    Driver driver;
    void* handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        driver.missing = fmt::format("there is no NVIDIA driver: {}", printable(dlerror()));
        return driver;
    }
#define MM_TEXT_OF(name) #name
#define MM_LOAD(name)                                                                                        \
    driver.name = reinterpret_cast<decltype(driver.name)>(dlsym(handle, MM_TEXT_OF(name)));                  \
    if (driver.name == nullptr) {                                                                            \
        driver.missing = fmt::format("NVIDIA's driver is too old: {} has no {}", library, MM_TEXT_OF(name)); \
        return driver;                                                                                       \
    }
    MM_DRIVER_FUNCTIONS(MM_LOAD)
#undef MM_LOAD
#undef MM_TEXT_OF
    if (const CUresult result = driver.cuInit(0); result != CUDA_SUCCESS) {
        driver.missing = fmt::format("NVIDIA's driver does not start: {}", text_of(driver, result));
    } else if (driver.cuDeviceGetCount(&driver.devices) != CUDA_SUCCESS || driver.devices == 0) {
        driver.devices = 0;
        driver.missing = "no NVIDIA GPU is here";
    }
    return driver;
}

}  // namespace

const Driver& driver()
{
    static const Driver only = opened();
    return only;
}

void check(CUresult result, const char* what)
{
    if (result != CUDA_SUCCESS) throw Error(fmt::format("cuda: {}: {}", what, text_of(driver(), result)));
}

}  // namespace mandelmarch::cuda
