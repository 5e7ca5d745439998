// SPDX-License-Identifier: Apache-2.0
#include "backends/opencl/device.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "core/os/cores.h"
#include "core/text/environment.h"
#include "core/text/text.h"

namespace mandelmarch::opencl {
namespace {

// Returns a property of a device or platform, up to its first 0.
std::string shown(const std::string& text) { return printable(trimmed(text.c_str())); }

const char* meaning(cl_int code)
{
    switch (code) {
        case CL_DEVICE_NOT_AVAILABLE: return "the device is not available";
        case CL_COMPILER_NOT_AVAILABLE: return "the device has no compiler";
        case CL_MEM_OBJECT_ALLOCATION_FAILURE: return "the device is out of memory";
        case CL_OUT_OF_RESOURCES: return "the device is out of resources, or died";
        case CL_OUT_OF_HOST_MEMORY: return "out of host memory";
        case CL_BUILD_PROGRAM_FAILURE: return "the kernel does not compile";
        case CL_INVALID_BUFFER_SIZE: return "the device refuses a buffer of that size";
        case CL_INVALID_COMMAND_QUEUE: return "the device is lost";
        default: return "the device refuses";
    }
}

namespace fs = std::filesystem;

// Returns the default cache folder of PoCL 3.1: pocl/kcache in $XDG_CACHE_HOME, or else in ~/.cache; empty if neither
// variable is set.
std::string usual_folder()
{
    if (const std::string caches = environment_variable("XDG_CACHE_HOME"); !caches.empty())
        return caches + "/pocl/kcache";
    if (const std::string home = environment_variable("HOME"); !home.empty()) return home + "/.cache/pocl/kcache";
    return {};
}

bool can_be_made(const std::string& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    return access(folder.c_str(), W_OK | X_OK) == 0;
}

// Returns true if the folder belongs to this user and nobody else can access it. In a shared temporary folder, another
// user may have created a folder of this name.
bool is_private(const std::string& folder)
{
    struct stat status {};
    return lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == geteuid() &&
           (status.st_mode & 077) == 0;
}

// PoCL, the OpenCL driver for CPUs, does not work without a folder in which it stores compiled kernels. If its default
// folder is not writable (for example, because the user has no home), sets POCL_CACHE_DIR to a per-user folder in the
// temporary folder. Must be called before the first call of OpenCL.
void provide_pocl_cache()
{
    if (!environment_variable("POCL_CACHE_DIR").empty()) return;
    unsetenv("POCL_CACHE_DIR");  // PoCL treats an empty value as a folder
    if (const std::string usual = usual_folder(); !usual.empty() && can_be_made(usual)) return;
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    if (error) return;
    const std::string folder = (temporary / fmt::format("mandelmarch-pocl-{}", geteuid())).string();
    mkdir(folder.c_str(), 0700);
    if (is_private(folder)) setenv("POCL_CACHE_DIR", folder.c_str(), 1);
}

}  // namespace

Error explained(const char* doing, const cl::Error& error)
{
    return Error(
        fmt::format("backend opencl: {}: {} ({} returned {})", doing, meaning(error.err()), error.what(), error.err()));
}

std::vector<cl::Device> all_devices()
{
    provide_pocl_cache();
    limit_driver_threads("POCL_MAX_PTHREAD_COUNT");
    std::vector<cl::Device> devices;
    try {
        std::vector<cl::Platform> platforms;
        cl::Platform::get(&platforms);
        for (const cl::Platform& platform : platforms) {
            try {
                std::vector<cl::Device> of_platform;
                platform.getDevices(CL_DEVICE_TYPE_ALL, &of_platform);
                devices.insert(devices.end(), of_platform.begin(), of_platform.end());
            } catch (const cl::Error&) {
                continue;  // a platform without devices returns an error
            }
        }
    } catch (const cl::Error&) {
        return {};  // no platform
    }
    return devices;
}

Device description(const cl::Device& device)
{
    const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
    return {.name = shown(device.getInfo<CL_DEVICE_NAME>()),
            .vendor = shown(device.getInfo<CL_DEVICE_VENDOR>()),
            .driver = fmt::format("{}, driver {}", shown(platform.getInfo<CL_PLATFORM_VERSION>()),
                                  shown(device.getInfo<CL_DRIVER_VERSION>())),
            .is_gpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_GPU) != 0};
}

Build build_for(const cl::Device& device, const RendererOptions& options)
{
    const bool is_float = options.precision == Precision::f32;
    const bool exact = options.mode == Mode::exact;
    const std::string name = shown(device.getInfo<CL_DEVICE_NAME>());
    const bool has_double = device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
    if (!is_float && !has_double) {
        throw Unavailable(fmt::format("backend opencl: {} has no double, expected --precision float", name));
    }

    Build build;
    // CPUs render one pixel per vector lane, in OpenCL vectors. GPUs use scalars, because the hardware combines
    // adjacent work items into its vectors.
    const bool is_cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    const cl_uint native = is_float ? device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>()
                                    : device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE>();
    // A vector of two to four machine registers hides part of the arithmetic's latency. OpenCL's vectors have at most
    // 16 elements, but PoCL's compiler, clang, supports longer ones.
    constexpr std::array lengths{1, 2, 4, 8, 16, 32};
    const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
    const bool is_pocl = shown(platform.getInfo<CL_PLATFORM_NAME>()) == "Portable Computing Language";
    const bool has_long = is_pocl && native >= (is_float ? 16 : 8);
    const int longest = has_long ? 32 : std::min(2 * static_cast<int>(native), 16);
    const int suits = is_cpu && native > 1 ? longest : 1;
    build.lanes = options.simd_width != 0 ? options.simd_width : suits;
    if (std::ranges::find(lengths, build.lanes) == lengths.end()) {
        throw InputError(
            fmt::format("--simd-width: {} is no vector length of opencl, expected 1, 2, 4, 8, 16 or 32", build.lanes));
    }

    const bool exact_float = (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    build.options = fmt::format("-cl-std=CL1.2 {} -DMM_REAL_IS_FLOAT={:d} -DMM_LANES={}",
                                exact ? MANDELMARCH_OPENCL_EXACT : MANDELMARCH_OPENCL_FAST, is_float, build.lanes);
    // OpenCL allows errors of 2.5 ulp in a float division and 3 ulp in a float square root. If they are computed in
    // double and then rounded to float, the results are correctly rounded.
    if (is_float && exact && exact_float) {
        build.options += " " MANDELMARCH_OPENCL_DIVISION;
    } else if (is_float && exact && has_double) {
        build.in_double = true;
    } else if (is_float && exact) {
        throw Unavailable(
            fmt::format("backend opencl: {} divides inexactly and has no double to help, expected --mode fast", name));
    }
    // NVIDIA's native functions are single instructions with errors of a few units in the last place. OpenCL itself
    // sets no limit to their errors, so other GPUs do not use them.
    const bool is_nvidia = shown(device.getInfo<CL_DEVICE_VENDOR>()).starts_with("NVIDIA");
    const bool native_words = is_nvidia && !is_cpu && is_float && !exact && build.lanes == 1;
    build.options += fmt::format(" -DMM_IN_DOUBLE={:d} -DMM_NATIVE={:d}", build.in_double, native_words);
    return build;
}

}  // namespace mandelmarch::opencl
