// SPDX-License-Identifier: Apache-2.0
// The Vulkan loader, its devices, and its errors.
#pragma once

#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "core/render/backend.h"
#include "core/text/error.h"

namespace mandelmarch::vulkan {

// An open loader and its devices. The constructor throws Unavailable if no loader or no driver is installed; the
// exception's message is the reason without the backend's name. Throws Error for the reasons of refuse_shortage().
class Instance {
public:
    Instance();

    // Returns the devices; GPUs come first.
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
    std::int64_t most_invocations = 0;      // max invocations resident on the device at once; 0: unknown
    bool has_double = false;
    bool shares_memory = false;  // uses the host's memory
    bool counts_loops = false;   // the device is lavapipe, which ends an invocation's loops after 65,535 iterations
};
DeviceInfo facts_of(const vk::raii::PhysicalDevice& physical);

// Returns a short description of an error, such as "device lost" or "out of device memory".
std::string describe(const vk::SystemError& error);

// Runs f, and converts a Vulkan error to an Error with the message "backend vulkan: PLACE: DESCRIPTION while DOING".
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
