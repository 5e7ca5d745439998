// SPDX-License-Identifier: Apache-2.0
#include "backends/vulkan/gpu.h"
#include "core/os/stopwatch.h"
#include "core/text/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mandelmarch::vulkan {
namespace {

constexpr auto look_again = std::chrono::milliseconds(100);
constexpr int timestamps = 3;

}  // namespace

Gpu::Gpu(const vk::raii::PhysicalDevice& physical, Precision precision)
    : physical_(physical), info_(facts_of(physical)), patience_(device_timeout())
{
    const auto refuse = [this](const std::string& why) {
        throw Unavailable(fmt::format("backend vulkan: {}: {}", name(), why));
    };
    if (info_.properties.apiVersion < VK_API_VERSION_1_1) refuse("supports only Vulkan 1.0, expected 1.1");
    if (precision == Precision::f64 && !info_.has_double)
        refuse("has no double (shaderFloat64), expected --precision float");
    const auto families = physical.getQueueFamilyProperties();
    const auto family = std::ranges::find_if(families, [](const vk::QueueFamilyProperties& one) {
        return static_cast<bool>(one.queueFlags & vk::QueueFlagBits::eCompute);
    });
    if (family == families.end()) refuse("has no compute queue");
    queue_family_ = static_cast<std::uint32_t>(family - families.begin());

    attempt(name(), "opening the device", [&] {
        const float priority = 1;
        const vk::DeviceQueueCreateInfo queue({}, queue_family_, 1, &priority);
        vk::PhysicalDeviceFeatures features;
        features.shaderFloat64 = info_.has_double ? 1 : 0;
        device_ = physical.createDevice(vk::DeviceCreateInfo({}, queue, {}, {}, &features));
        queue_ = device_.getQueue(queue_family_, 0);
        pool_ = device_.createCommandPool({vk::CommandPoolCreateFlagBits::eResetCommandBuffer, queue_family_});
        commands_ = std::move(device_.allocateCommandBuffers({*pool_, vk::CommandBufferLevel::ePrimary, 1}).front());
        fence_ = device_.createFence({});
        if (const std::uint32_t bits = family->timestampValidBits; bits > 0) {
            clock_mask_ = bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
            clock_ = device_.createQueryPool({{}, vk::QueryType::eTimestamp, timestamps});
        }
    });
}

std::uint32_t Gpu::memory_type(std::uint32_t allowed, Place place, const std::string& what) const
{
    using Flag = vk::MemoryPropertyFlagBits;
    const auto wishes = place == Place::host
                            ? std::array{Flag::eHostVisible | Flag::eHostCoherent | Flag::eHostCached,
                                         Flag::eHostVisible | Flag::eHostCoherent}
                            : std::array{vk::MemoryPropertyFlags(Flag::eDeviceLocal), vk::MemoryPropertyFlags()};
    const auto memory = physical_.getMemoryProperties();
    for (const vk::MemoryPropertyFlags wish : wishes) {
        for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
            if ((allowed >> type & 1) != 0 && (memory.memoryTypes[type].propertyFlags & wish) == wish) return type;
        }
    }
    throw Error(fmt::format("backend vulkan: {}: there is no memory for {}", name(), what));
}

Buffer Gpu::make_buffer(vk::DeviceSize size, Place place, const std::string& what) const
{
    return attempt(name(), fmt::format("taking {} KiB for {}", (size + 1023) >> 10, what), [&] {
        using Usage = vk::BufferUsageFlagBits;
        Buffer buffer;
        buffer.size = size;
        buffer.handle = device_.createBuffer(
            vk::BufferCreateInfo({}, size, Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst));
        const auto needs = buffer.handle.getMemoryRequirements();
        buffer.memory = device_.allocateMemory({needs.size, memory_type(needs.memoryTypeBits, place, what)});
        buffer.handle.bindMemory(*buffer.memory, 0);
        if (place == Place::host) buffer.bytes = static_cast<std::byte*>(buffer.memory.mapMemory(0, VK_WHOLE_SIZE));
        return buffer;
    });
}

const vk::raii::CommandBuffer& Gpu::commands()
{
    if (recording_) return commands_;
    recording_ = true;
    stopped_ = false;
    commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    if (*clock_) {
        commands_.resetQueryPool(*clock_, 0, timestamps);
        commands_.writeTimestamp(vk::PipelineStageFlagBits::eTopOfPipe, *clock_, 0);
    }
    return commands_;
}

void Gpu::barrier()
{
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    const auto written = Access::eShaderWrite | Access::eTransferWrite;
    const auto touched = written | Access::eShaderRead | Access::eTransferRead;
    commands().pipelineBarrier(Stage::eComputeShader | Stage::eTransfer,
                               Stage::eComputeShader | Stage::eTransfer | Stage::eHost, {},
                               vk::MemoryBarrier(written, touched | Access::eHostRead), {}, {});
}

void Gpu::discard()
{
    if (recording_) commands_.reset();
    recording_ = false;
}

void Gpu::stop_clock()
{
    if (*clock_ && !stopped_) commands().writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *clock_, 1);
    stopped_ = true;
}

void Gpu::read_clock(Took& took) const
{
    if (!*clock_) return;
    constexpr auto flags = vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait;
    constexpr auto size = sizeof(std::uint64_t);
    const auto notes = clock_.getResults<std::uint64_t>(0, timestamps, timestamps * size, size, flags).second;
    const auto seconds_from = [&](std::size_t i) {
        const std::uint64_t ticks = (notes[i + 1] - notes[i]) & clock_mask_;
        return 1e-9 * info_.properties.limits.timestampPeriod * static_cast<double>(ticks);
    };
    took.device = seconds_from(0);
    took.copies = seconds_from(1);
    took.host = std::max(0.0, took.host - took.copies);
}

Took Gpu::finish(const std::string& doing)
{
    if (!recording_) return {};
    stop_clock();
    recording_ = false;
    const auto start = Clock::now();
    Took took;
    attempt(name(), doing, [&] {
        if (*clock_) commands_.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *clock_, 2);
        commands_.end();
        device_.resetFences(*fence_);
        queue_.submit(vk::SubmitInfo({}, {}, *commands_), *fence_);
        const auto slice =
            std::min<Clock::duration>(std::chrono::duration_cast<Clock::duration>(patience_), look_again);
        const auto wait = static_cast<std::uint64_t>(std::chrono::nanoseconds(slice).count());
        while (device_.waitForFences(*fence_, 1, wait) == vk::Result::eTimeout) {
            if (Clock::now() - start < patience_) continue;
            throw DeviceHung(
                fmt::format("backend vulkan: {}: no answer within {} s while {} (MANDELMARCH_DEVICE_TIMEOUT)", name(),
                            patience_.count(), doing));
        }
        took.host = seconds_since(start);
        read_clock(took);
    });
    return took;
}

}  // namespace mandelmarch::vulkan
