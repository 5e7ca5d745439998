// SPDX-License-Identifier: Apache-2.0
// The OpenACC run-time library's devices and memory.
#pragma once

#include <cstddef>
#include <vector>

#include "core/render/backend.h"

namespace mandelmarch::openacc {

// The NVIDIA GPUs come first, then the host.
int device_count();

// Opens the device, which makes a GPU's driver translate all kernels.
Device open_device(int index);

// Makes the calling thread use this device.
void use_device(const Device& device, int index);

// Bytes that a GPU has free.
std::size_t free_memory(int index);

// Memory of the device that was current when it was taken. Throws Error where there is none left.
class DeviceMemory {
public:
    explicit DeviceMemory(std::size_t bytes);
    ~DeviceMemory();
    DeviceMemory(const DeviceMemory&) = delete;
    DeviceMemory& operator=(const DeviceMemory&) = delete;

    void* address() const { return address_; }
    void upload(const void* from, std::size_t bytes) const;
    void read_back(void* to, std::size_t bytes) const;

private:
    void* address_;
};

}  // namespace mandelmarch::openacc
