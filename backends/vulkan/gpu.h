// SPDX-License-Identifier: Apache-2.0
// One opened device: its queue, its memory, and waiting for it.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "backends/vulkan/instance.h"

namespace mandelmarch::vulkan {

// Memory that shaders see as a storage buffer.
struct Buffer {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Buffer handle = nullptr;
    vk::DeviceSize size = 0;     // bytes
    std::byte* bytes = nullptr;  // where the host sees it, or nullptr
};

enum class Place { device, host };

// Seconds that work took.
struct Took {
    double host = 0;                    // from handing it over to knowing that it is done
    std::optional<double> device = {};  // by the device's clock, if it has one
};

class Gpu {
public:
    // Throws Unavailable if the device lacks what `precision` needs.
    Gpu(const vk::raii::PhysicalDevice& physical, Precision precision);

    const Facts& facts() const { return facts_; }
    const std::string& name() const { return facts_.device.name; }
    const vk::raii::Device& device() const { return device_; }

    // A buffer for shaders and copies. `what` names it for the user.
    Buffer make_buffer(vk::DeviceSize size, Place place, const std::string& what) const;

    // The command buffer that is being recorded.
    const vk::raii::CommandBuffer& commands();
    // Lets what follows see what shaders and copies before it have written, on the device and on the host.
    void barrier();
    // Hands over what was recorded, if anything, and waits until it is done. Throws Error if the device is lost, and
    // DeviceHung if it does not answer in time: its work may still be under way, so that nothing that it uses may be
    // destroyed, and destroying it might never return.
    Took finish(const std::string& doing);

    // Forgets what was recorded.
    void discard();

private:
    std::uint32_t memory_type(std::uint32_t allowed, Place place, const std::string& what) const;
    // Seconds between the two times that the device noted of the work that it has done; nullopt without a clock.
    std::optional<double> device_seconds() const;

    const vk::raii::PhysicalDevice& physical_;
    Facts facts_;
    std::chrono::duration<double> patience_;
    std::uint32_t queue_family_ = 0;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    vk::raii::CommandPool pool_ = nullptr;
    vk::raii::CommandBuffer commands_ = nullptr;
    vk::raii::Fence fence_ = nullptr;
    vk::raii::QueryPool clock_ = nullptr;  // notes when work begins and when it ends; null: the device has no clock
    std::uint64_t clock_mask_ = 0;         // the bits of a note
    bool recording_ = false;
};

}  // namespace mandelmarch::vulkan
