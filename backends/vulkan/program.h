// SPDX-License-Identifier: Apache-2.0
// Shader programs on a device: SPIR-V modules, and the pipelines made of them, which are created on first use. Drivers
// keep what they have compiled in caches of their own.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/gpu.h"

namespace mandelmarch::vulkan {

// A SPIR-V module. The generated modules are named FRACTAL_PRECISION_MODE, probe_PRECISION_exact and
// peak_PRECISION_fast. Each float module of exact mode also exists with the suffix _corrected, which corrects divisions
// by their exact residuals (core/kernel/prelude/glsl.h).
using Module = std::span<const std::uint32_t>;

// Returns a module; empty if no module has this name.
Module module_named(std::string_view name);

// A range of a buffer, as bound to a shader.
struct Binding {
    const Buffer* buffer;
    vk::DeviceSize offset;  // bytes
    vk::DeviceSize size;    // bytes
};

// A loaded module. All shaders use the same interface: storage buffers 0, 1, ... in set 0, six ints of push constants,
// and four ints of specialization constants.
class Program {
public:
    using Ints = std::array<std::int32_t, 4>;
    using Pushed = std::array<std::int32_t, 6>;

    Program(const Gpu& gpu, Module module, int buffers);

    void bind(std::span<const Binding> bindings) const;

    // Returns true if the pipeline of these specialization constants does not exist yet. dispatch() would create it.
    bool lacks(const Ints& constants) const { return !pipelines_.contains(constants); }

    // Records a dispatch into the GPU's command buffer. The caller adds barriers.
    void dispatch(Gpu& gpu, const Ints& constants, const Pushed& pushed, std::uint32_t groups_x,
                  std::uint32_t groups_y);

private:
    const vk::raii::Pipeline& pipeline(const Gpu& gpu, const Ints& constants);

    const vk::raii::Device& device_;
    vk::raii::ShaderModule module_ = nullptr;
    vk::raii::DescriptorSetLayout set_layout_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::DescriptorSet set_;  // owned by the pool
    std::map<Ints, vk::raii::Pipeline> pipelines_;
};

}  // namespace mandelmarch::vulkan
