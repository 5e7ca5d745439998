// The OpenACC run-time library's devices and memory.
#pragma once

#include <cstddef>
#include <vector>

#include "core/render/backend.h"

namespace mandelmarch::openacc {

// The NVIDIA GPUs, then the host. Opens every GPU, which makes its driver translate all kernels.
std::vector<Device> find_devices();

// Makes the calling thread use this device of find_devices().
void use_device(const Device& device, int index);

// Bytes that the current device has free; the host tells none and gets 0.
std::size_t free_memory(const Device& device);

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
