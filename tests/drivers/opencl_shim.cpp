// SPDX-License-Identifier: Apache-2.0
// A library that is preloaded before libOpenCL and makes a good driver fail (faults.h). Calls that the fault does not
// affect go to the real driver. The words are
//   memory             clCreateBuffer returns CL_MEM_OBJECT_ALLOCATION_FAILURE
//   lost               clEnqueueNDRangeKernel returns CL_OUT_OF_RESOURCES
//   silent             clEnqueueNDRangeKernel returns an event that never completes
//   absent             there is no platform
//   no_double          no device has double
//   inexact            float division has an error of about a unit in the last place, and the device reports this
//   inexact_liar       the same, but the device reports that its division is exact
//   no_double_inexact  the device lacks double and reports that its division is inexact
//   nvidia             the device reports that it is a GPU of NVIDIA
//   small_buffers      a buffer has at most 1 MiB
#include <CL/cl.h>
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "tests/drivers/faults.h"

namespace {

using mandelmarch::drivers::driver_faults;
using mandelmarch::drivers::fails;
using mandelmarch::drivers::has_fault;

// Called when the library is loaded. Some tests use this library as a driver, which OpenCL's loader opens.
__attribute__((constructor)) void load() { driver_faults("load"); }

template <class Function>
Function* real(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                              const size_t* global, const size_t* local, cl_uint waits, const cl_event* wait,
                              cl_event* event)
{
    driver_faults("launch");
    if (fails("lost")) return CL_OUT_OF_RESOURCES;
    if (fails("silent")) {
        // Returns an event that never completes.
        cl_context context = nullptr;
        clGetCommandQueueInfo(queue, CL_QUEUE_CONTEXT, sizeof(context), &context, nullptr);
        cl_int error = CL_SUCCESS;
        *event = clCreateUserEvent(context, &error);
        return error;
    }
    return real<decltype(clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel")(queue, kernel, dimensions, offset, global,
                                                                            local, waits, wait, event);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* host, cl_int* error)
{
    if (fails("memory")) {
        *error = CL_MEM_OBJECT_ALLOCATION_FAILURE;
        return nullptr;
    }
    return real<decltype(clCreateBuffer)>("clCreateBuffer")(context, flags, size, host, error);
}

cl_int clBuildProgram(cl_program program, cl_uint devices, const cl_device_id* device, const char* options,
                      void (*notify)(cl_program, void*), void* data)
{
    if (driver_faults("build")) return CL_BUILD_PROGRAM_FAILURE;
    return real<decltype(clBuildProgram)>("clBuildProgram")(program, devices, device, options, notify, data);
}

cl_program clCreateProgramWithSource(cl_context context, cl_uint count, const char** strings, const size_t* lengths,
                                     cl_int* error)
{
    auto* create = real<decltype(clCreateProgramWithSource)>("clCreateProgramWithSource");
    if (!has_fault("inexact") && !has_fault("inexact_liar")) return create(context, count, strings, lengths, error);
    constexpr std::string_view exact = "return a / b;";
    std::string text(strings[0], lengths[0]);
    const auto at = text.find(exact);
    if (at == std::string::npos) std::abort();  // the prelude has changed: adapt this mutant
    text.replace(at, exact.size(), "return a * (1 / b);");
    const char* begin = text.c_str();
    return create(context, 1, &begin, nullptr, error);
}

// Called when the picture is mapped for reading.
void* clEnqueueMapBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, cl_map_flags flags, size_t offset,
                         size_t size, cl_uint waits, const cl_event* wait, cl_event* event, cl_int* error)
{
    driver_faults("map");
    return real<decltype(clEnqueueMapBuffer)>("clEnqueueMapBuffer")(queue, buffer, blocking, flags, offset, size, waits,
                                                                    wait, event, error);
}

cl_int clReleaseContext(cl_context context)
{
    driver_faults("release");
    return real<decltype(clReleaseContext)>("clReleaseContext")(context);
}

cl_int clGetPlatformIDs(cl_uint entries, cl_platform_id* platforms, cl_uint* count)
{
    driver_faults("list");
    if (has_fault("absent")) return -1001;  // CL_PLATFORM_NOT_FOUND_KHR
    return real<decltype(clGetPlatformIDs)>("clGetPlatformIDs")(entries, platforms, count);
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t size, void* value, size_t* written)
{
    const cl_int result = real<decltype(clGetDeviceInfo)>("clGetDeviceInfo")(device, what, size, value, written);
    if (what == CL_DEVICE_NAME && value != nullptr && driver_faults("list")) {
        std::memset(value, 0, size);
        std::strncpy(static_cast<char*>(value), mandelmarch::drivers::garbage_name.data(), size - 1);
    }
    const bool no_double = has_fault("no_double") || has_fault("no_double_inexact");
    if (value != nullptr && no_double && what == CL_DEVICE_DOUBLE_FP_CONFIG) std::memset(value, 0, size);
    if (value != nullptr && (has_fault("inexact") || has_fault("no_double_inexact")) &&
        what == CL_DEVICE_SINGLE_FP_CONFIG) {
        *static_cast<cl_device_fp_config*>(value) &=
            ~static_cast<cl_device_fp_config>(CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT);
    }
    if (value != nullptr && has_fault("inexact_liar") && what == CL_DEVICE_SINGLE_FP_CONFIG) {
        *static_cast<cl_device_fp_config*>(value) |= CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
    }
    if (has_fault("nvidia") && what == CL_DEVICE_TYPE && value != nullptr) {
        *static_cast<cl_device_type*>(value) = CL_DEVICE_TYPE_GPU;
    }
    if (has_fault("nvidia") && what == CL_DEVICE_VENDOR) {
        constexpr std::string_view vendor = "NVIDIA Corporation";
        if (written != nullptr) *written = vendor.size() + 1;
        if (value != nullptr) std::strncpy(static_cast<char*>(value), vendor.data(), size);
        return CL_SUCCESS;
    }
    if (value != nullptr && has_fault("small_buffers") && what == CL_DEVICE_MAX_MEM_ALLOC_SIZE) {
        *static_cast<cl_ulong*>(value) = 1 << 20;
    }
    return result;
}

}  // extern "C"
