// SPDX-License-Identifier: Apache-2.0
// The Vulkan loader, its devices, and how its failures are told.
#pragma once

#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "core/base/error.h"
#include "core/render/backend.h"

namespace mandelmarch::vulkan {

// An open loader and what it sees. Throws Unavailable with the bare reason where there is no loader or no driver.
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

// What a physical device says of itself.
struct Facts {
    Device device;
    vk::PhysicalDeviceProperties properties;
    vk::DeviceSize largest_allocation = 0;  // bytes
    std::int64_t most_invocations = 0;      // that it holds at once; 0: it does not tell
    bool has_double = false;
    bool shares_memory = false;  // the host's memory is its own
    bool counts_loops = false;   // lavapipe: an invocation ends silently after about 65,535 loop iterations
};
Facts facts_of(const vk::raii::PhysicalDevice& physical);

// In a few words: "device lost", "out of device memory".
std::string describe(const vk::SystemError& error);

// Runs f; a Vulkan failure becomes an Error: "backend vulkan: PLACE: what while DOING".
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
