// SPDX-License-Identifier: Apache-2.0
// The Vulkan loader, its devices, and its errors.
#pragma once

#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "core/base/error.h"
#include "core/render/backend.h"

namespace mandelmarch::vulkan {

// An open loader and its devices. Throws Unavailable, with the reason only, if no loader or no driver exists.
class Instance {
public:
    Instance();

    // GPUs first.
    const std::vector<vk::raii::PhysicalDevice>& devices() const { return devices_; }

private:
    vk::raii::Context context_;
    vk::raii::Instance instance_;
    std::vector<vk::raii::PhysicalDevice> devices_;
};

// Properties of a physical device.
struct DeviceInfo {
    Device device;
    vk::PhysicalDeviceProperties properties;
    vk::DeviceSize largest_allocation = 0;  // bytes
    std::int64_t most_invocations = 0;      // resident at once; 0: unknown
    bool has_double = false;
    bool shares_memory = false;  // uses the host's memory
    bool counts_loops = false;   // lavapipe: an invocation silently ends after about 65,535 loop iterations
};
DeviceInfo facts_of(const vk::raii::PhysicalDevice& physical);

// Returns a short description: "device lost", "out of device memory".
std::string describe(const vk::SystemError& error);

// Runs f and converts Vulkan errors to Error: "backend vulkan: PLACE: what while DOING".
template <class Function>
decltype(auto) attempt(const std::string& place, const std::string& doing, Function f)
{
    try {
        return f();
    } catch (const vk::SystemError& error) {
        throw Error("backend vulkan: " + place + ": " + describe(error) + " while " + doing);
    }
}

}  // namespace mandelmarch::vulkan
