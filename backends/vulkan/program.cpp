// SPDX-License-Identifier: Apache-2.0
#include "backends/vulkan/program.h"

#include <array>

namespace mandelmarch::vulkan {
Program::Program(const Gpu& gpu, Module module, int buffers) : device_(gpu.device())
{
    attempt(gpu.name(), "loading a shader", [&] {
        const auto count = static_cast<std::uint32_t>(buffers);
        module_ = device_.createShaderModule(vk::ShaderModuleCreateInfo({}, module.size_bytes(), module.data()));
        std::vector<vk::DescriptorSetLayoutBinding> bindings;
        for (std::uint32_t i = 0; i < count; ++i) {
            bindings.emplace_back(i, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute);
        }
        set_layout_ = device_.createDescriptorSetLayout(vk::DescriptorSetLayoutCreateInfo({}, bindings));
        const vk::PushConstantRange pushed(vk::ShaderStageFlagBits::eCompute, 0, sizeof(Pushed));
        layout_ = device_.createPipelineLayout(vk::PipelineLayoutCreateInfo({}, *set_layout_, pushed));
        const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer, count);
        pool_ = device_.createDescriptorPool(vk::DescriptorPoolCreateInfo({}, 1, size));
        // The set is released together with its pool, because the pool cannot free single sets.
        set_ = vk::raii::DescriptorSets(device_, vk::DescriptorSetAllocateInfo(*pool_, *set_layout_)).front().release();
    });
}

void Program::bind(std::span<const Binding> bindings) const
{
    std::vector<vk::DescriptorBufferInfo> infos;
    infos.reserve(bindings.size());
    for (const Binding& binding : bindings) infos.emplace_back(*binding.buffer->handle, binding.offset, binding.size);
    device_.updateDescriptorSets(vk::WriteDescriptorSet(set_, 0, 0, vk::DescriptorType::eStorageBuffer, {}, infos), {});
}

const vk::raii::Pipeline& Program::pipeline(const Gpu& gpu, const Ints& constants)
{
    const auto found = pipelines_.find(constants);
    if (found != pipelines_.end()) return found->second;
    return attempt(gpu.name(), "building a pipeline", [&]() -> const vk::raii::Pipeline& {
        std::array<vk::SpecializationMapEntry, std::tuple_size_v<Ints>> entries;
        for (std::uint32_t i = 0; i < entries.size(); ++i) entries[i] = vk::SpecializationMapEntry(i, i * 4, 4);
        const vk::SpecializationInfo specialization(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                                    sizeof constants, constants.data());
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module_, "main",
                                                      &specialization);
        auto made = device_.createComputePipeline(nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout_));
        return pipelines_.emplace(constants, std::move(made)).first->second;
    });
}

void Program::dispatch(Gpu& gpu, const Ints& constants, const Pushed& pushed, std::uint32_t groups_x,
                       std::uint32_t groups_y)
{
    const vk::raii::Pipeline& ready = pipeline(gpu, constants);
    const vk::raii::CommandBuffer& commands = gpu.commands();
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *ready);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, set_, {});
    commands.pushConstants<std::int32_t>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, pushed);
    commands.dispatch(groups_x, groups_y, 1);
}

}  // namespace mandelmarch::vulkan
