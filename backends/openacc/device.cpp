// SPDX-License-Identifier: Apache-2.0
#include "backends/openacc/device.h"

#include <fmt/format.h>
#include <openacc.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace mandelmarch::openacc {
namespace {

std::string text_of(int device, acc_device_property_t property)
{
    const char* text = acc_get_property_string(device, acc_device_nvidia, property);
    return text != nullptr && *text != '\0' ? printable(text) : "unknown";
}

}  // namespace

int device_count() { return acc_get_num_devices(acc_device_nvidia) + 1; }

Device open_device(int index)
{
    const int gpus = acc_get_num_devices(acc_device_nvidia);
    if (index < gpus) {
        acc_set_device_num(index, acc_device_nvidia);
        return {.name = text_of(index, acc_property_name),
                .vendor = text_of(index, acc_property_vendor),
                .driver = text_of(index, acc_property_driver),
                .is_gpu = true};
    }
    return {.name = fmt::format("host, one thread: {}", gpus == 0 ? "no NVIDIA GPU here" : "instead of a GPU"),
            .vendor = "OpenACC run-time library",
            .driver = "compiler " __VERSION__,
            .is_gpu = false};
}

void use_device(const Device& device, int index)
{
    if (device.is_gpu) {
        acc_set_device_num(index, acc_device_nvidia);
    } else {
        // Not acc_set_device_type(): it takes ACC_DEVICE_NUM for the host too, and libgomp 14 hangs where there is none.
        acc_set_device_num(0, acc_device_host);
    }
}

std::size_t free_memory(int index) { return acc_get_property(index, acc_device_nvidia, acc_property_free_memory); }

DeviceMemory::DeviceMemory(std::size_t bytes) : address_(acc_malloc(bytes))
{
    if (address_ == nullptr) throw Error(fmt::format("openacc: the device has no {} bytes of memory free", bytes));
}

DeviceMemory::~DeviceMemory() { acc_free(address_); }

void DeviceMemory::upload(const void* from, std::size_t bytes) const
{
    // The library's declaration lacks a const.
    acc_memcpy_to_device(address_, const_cast<void*>(from), bytes);
}

void DeviceMemory::read_back(void* to, std::size_t bytes) const { acc_memcpy_from_device(to, address_, bytes); }

}  // namespace mandelmarch::openacc
