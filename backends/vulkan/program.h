// SPDX-License-Identifier: Apache-2.0
// A module on a device, with its pipelines, which are created on first use, and the binding of its buffers.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>

#include "backends/vulkan/gpu.h"
#include "backends/vulkan/modules.h"
#include "backends/vulkan/pipeline_cache.h"

namespace mandelmarch::vulkan {

// A range of a buffer, as bound to a shader.
struct Binding {
    const Buffer* buffer;
    vk::DeviceSize offset;  // bytes
    vk::DeviceSize size;    // bytes
};

// A loaded module. All shaders use the same interface: storage buffers 0, 1, ... in set 0, four ints of push constants,
// and four ints of specialization constants.
class Program {
public:
    using Ints = std::array<std::int32_t, 4>;

    Program(const Gpu& gpu, Module module, int buffers);

    void bind(std::span<const Binding> bindings) const;

    // Returns true if the pipeline of these specialization constants does not exist yet. dispatch() would create it.
    bool lacks(const Ints& constants) const { return !pipelines_.contains(constants); }

    // Records a dispatch into the GPU's command buffer. The caller adds barriers.
    void dispatch(Gpu& gpu, const Ints& constants, const Ints& pushed, std::uint32_t groups_x, std::uint32_t groups_y);

private:
    const vk::raii::Pipeline& pipeline(const Gpu& gpu, const Ints& constants);

    const vk::raii::Device& device_;
    vk::raii::ShaderModule module_ = nullptr;
    vk::raii::DescriptorSetLayout set_layout_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::DescriptorSet set_;  // owned by the pool
    PipelineCache cache_;
    std::map<Ints, vk::raii::Pipeline> pipelines_;
};

}  // namespace mandelmarch::vulkan
