// SPDX-License-Identifier: Apache-2.0
// An opened device with its queue and command buffer. Makes buffers, submits work, and waits for its end.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "backends/vulkan/instance.h"

namespace mandelmarch::vulkan {

// A storage buffer for shaders.
struct Buffer {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Buffer handle = nullptr;
    vk::DeviceSize size = 0;     // bytes
    std::byte* bytes = nullptr;  // address at which the host can access the buffer; nullptr if it cannot
};

enum class Place { device, host };

// Durations of finished work, in seconds. A device without a clock counts copies as a part of `host`.
struct Took {
    double host = 0;                    // from the submission until the host detects the end, without `copies`
    std::optional<double> device = {};  // until stop_clock(), by the device's clock; nullopt if it has none
    double copies = 0;                  // from stop_clock() to the end, by the device's clock
};

class Gpu {
public:
    // Opens the device. Throws Unavailable if it lacks a feature that `precision` requires.
    Gpu(const vk::raii::PhysicalDevice& physical, Precision precision);

    const DeviceInfo& info() const { return info_; }
    const std::string& name() const { return info_.device.name; }
    const vk::raii::Device& device() const { return device_; }

    // Makes a buffer that shaders and copies can use. Error messages call it `what`.
    Buffer make_buffer(vk::DeviceSize size, Place place, const std::string& what) const;

    // Returns the command buffer, ready to record commands.
    const vk::raii::CommandBuffer& commands();
    // Makes earlier writes of shaders and copies visible to later commands, on the device and on the host.
    void barrier();
    // The commands recorded after this call are copies for the host.
    void stop_clock();
    // Submits the recorded commands, if any, and waits for them. Throws Error if the device is lost. Throws DeviceHung
    // if the device does not respond in time. Its work may then still be running, so the caller must not destroy
    // anything that this work uses, nor this object, whose destructor might never return.
    Took finish(const std::string& doing);

    // Discards the recorded commands.
    void discard();

private:
    std::uint32_t memory_type(std::uint32_t allowed, Place place, const std::string& what) const;
    // Adds the times between the timestamps of the finished work, if the device has a clock.
    void read_clock(Took& took) const;

    const vk::raii::PhysicalDevice& physical_;
    DeviceInfo info_;
    std::chrono::duration<double> patience_;
    std::uint32_t queue_family_ = 0;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    vk::raii::CommandPool pool_ = nullptr;
    vk::raii::CommandBuffer commands_ = nullptr;
    vk::raii::Fence fence_ = nullptr;
    vk::raii::QueryPool clock_ = nullptr;  // timestamps: start, stop_clock(), end; null: no clock
    std::uint64_t clock_mask_ = 0;         // the valid bits of a timestamp
    bool recording_ = false;
    bool stopped_ = false;  // stop_clock() has been called for the recorded commands
};

}  // namespace mandelmarch::vulkan
