// SPDX-License-Identifier: Apache-2.0
// Devices of g++'s run-time library, which are NVIDIA GPUs. OpenMP has no query for a device's name and memory.
// OpenACC, which is in the same run-time library, has such queries, and numbers the devices in the same way.
#include <omp.h>
#include <openacc.h>

#include <string>

#include "backends/omptarget/devices.h"
#include "core/gpu/driver.h"
#include "core/render/schedule.h"
#include "core/text/text.h"

namespace mandelmarch::omptarget {
namespace {

std::string text_of(int device, acc_device_property_t property)
{
    const char* text = acc_get_property_string(device, acc_device_nvidia, property);
    return text != nullptr && *text != '\0' ? printable(text) : "unknown";
}

}  // namespace

const char* const kind = "NVIDIA GPU";

job::OpenedDevice opened(int index, job::Chains*)
{
    // OpenACC must come first: it refuses to begin with a device that OpenMP has opened.
    const Device device{.name = text_of(index, acc_property_name),
                        .vendor = text_of(index, acc_property_vendor),
                        .driver = text_of(index, acc_property_driver),
                        .is_gpu = true};
    omp_target_free(omp_target_alloc(1, index), index);  // opens the device: the driver translates the kernels
    const job::GpuSize size = job::size_of(job::nvidia_driver(), index);
    return {.device = device,
            .instruction_set = "PTX for sm_35",
            .pixels_per_band = pixels_of_gpu(size.resident_threads),
            .multiprocessors = size.multiprocessors,
            .resident_warps = size.capability < 70 ? job::resident_warps_before_70 : job::resident_warps,
            .peak_threads = 1 << 21};
}

std::optional<std::size_t> free_memory(int index)
{
    return acc_get_property(index, acc_device_nvidia, acc_property_free_memory);
}

}  // namespace mandelmarch::omptarget
